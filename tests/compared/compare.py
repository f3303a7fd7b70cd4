#!/usr/bin/env python3
"""Operations of value and gradient of the functions in objectives.rs: `aim generate` beside SymPy, CasADi, wrenfold and SymEngine.

Usage: compare.py AIM [--check PAGE]; AIM is the built binary, PAGE has the table. Needs
`pip install sympy casadi wrenfold symengine`, the last of which stands for SymForce, which takes its derivatives and common parts from it. Additions, subtractions, multiplications,
divisions and square roots count one each; negations, calls of functions, comparisons and selects do not. A whole power is
counted as the fewest multiplications. Of SymPy the best of its ways to find common subexpressions counts, of CasADi the
best with and without them, reverse and forward.
"""

import ast
import math
import re
import subprocess
import sys
from pathlib import Path

import casadi
import symengine
import sympy
from wrenfold import code_generation as cg
from wrenfold import sym
from wrenfold import type_annotations as ta

OBJECTIVES = Path(__file__).with_name("objectives.rs")


class Maths:
    """Functions of one of the tools, and vectors as lists."""

    def __init__(self, tool):
        self.sqrt, self.sin, self.cos, self.exp, self.log = tool.sqrt, tool.sin, tool.cos, tool.exp, tool.log
        self.atan2, self.tan, self.acos = tool.atan2, tool.tan, tool.acos


def number(like, above, below):
    """A fraction as the tool of `like` has it."""
    if isinstance(like, sympy.Basic):
        return sympy.Rational(above, below)
    if isinstance(like, symengine.Basic):
        return symengine.Rational(above, below)
    if isinstance(like, sym.Expr):
        return sym.rational(above, below)
    return above / below


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def scale(k, v):
    return [k * x for x in v]


def fisheye(m, p, focal, k, seen):
    r = m.sqrt(p[0] * p[0] + p[1] * p[1])
    theta = m.atan2(r, p[2])
    size = focal[0] * theta * (1 + k[0] * theta * theta) / r
    u, v = size * p[0] - seen[0], size * p[1] - seen[1]
    return u * u + v * v


def stereo(m, p, focal, baseline, seen):
    left = focal[0] * p[0] / p[2] - seen[0]
    right = focal[0] * (p[0] - baseline[0]) / p[2] - seen[1]
    height = focal[0] * p[1] / p[2] - seen[2]
    return left * left + right * right + height * height


def sampson(m, t, r, a, b):
    columns = [r[0:3], r[3:6], r[6:9]]
    ra = [sum(columns[k][i] * a[k] for k in range(3)) for i in range(3)]
    line = cross(t, ra)
    back = [dot(column, cross(b, t)) for column in columns]
    e = dot(b, line)
    return e * e / (line[0] * line[0] + line[1] * line[1] + back[0] * back[0] + back[1] * back[1])


def cloth(m, a, b, c, rest, mu, lam):
    p, q = sub(b, a), sub(c, a)
    u = add(scale(rest[0], p), scale(rest[1], q))
    v = add(scale(rest[2], p), scale(rest[3], q))
    half = number(a[0], 1, 2)
    exx, eyy, exy = half * (dot(u, u) - 1), half * (dot(v, v) - 1), half * dot(u, v)
    trace = exx + eyy
    return mu[0] * (exx * exx + eyy * eyy + 2 * exy * exy) + half * lam[0] * trace * trace


def hinge(m, a, b, c, d, stiffness):
    edge = sub(b, a)
    n, o = cross(sub(c, a), edge), cross(edge, sub(d, a))
    return stiffness[0] * (1 - dot(n, o) / (m.sqrt(dot(n, n)) * m.sqrt(dot(o, o))))


def microfacets(m, alpha, light, view, normal):
    total = add(light, view)
    c = dot(normal, total) / m.sqrt(dot(total, total))
    a2 = alpha[0] * alpha[0]
    d = c * c * (a2 - 1) + 1
    return a2 / (math.pi * d * d)


def joined_distance(m, p, center, radius, normal, offset, sharp):
    off = sub(p, center)
    sphere = m.sqrt(dot(off, off)) - radius[0]
    plane = dot(normal, p) - offset[0]
    return -m.log(m.exp(-sharp[0] * sphere) + m.exp(-sharp[0] * plane)) / sharp[0]


def pendulum(m, angle, speed, torque, step, pull, weight):
    (angle,), (speed,), (torque,), (step,), (pull,), (weight,) = angle, speed, torque, step, pull, weight
    half = number(angle, 1, 2)
    acceleration = torque - pull * m.sin(angle)
    half_angle = angle + half * step * speed
    half_speed = speed + half * step * acceleration
    angle = angle + step * half_speed
    speed = speed + step * (torque - pull * m.sin(half_angle))
    return angle * angle + weight * speed * speed + 0.01 * torque * torque


def spinning(m, spin, torque, inertia, wanted):
    gyroscopic = cross(spin, [i * s for i, s in zip(inertia, spin)])
    off = [(t - g) / i - w for t, g, i, w in zip(torque, gyroscopic, inertia, wanted)]
    return dot(off, off)


def pair(m, a, b, depth, sigma, charge):
    d = sub(a, b)
    r2 = dot(d, d)
    s2 = sigma[0] * sigma[0] / r2
    s6 = s2 * s2 * s2
    return 4 * depth[0] * (s6 * s6 - s6) + charge[0] / m.sqrt(r2)


def bond_angle(m, a, b, c, stiffness, rest):
    u, v = sub(a, b), sub(c, b)
    half = number(a[0], 1, 2)
    off = dot(u, v) / (m.sqrt(dot(u, u)) * m.sqrt(dot(v, v))) - rest[0]
    return half * stiffness[0] * off * off


def three_atoms(m, a, b, c, strength):
    u, v, w = sub(b, a), sub(c, b), sub(a, c)
    product = dot(u, u) * dot(v, v) * dot(w, w)
    cosines = -(dot(u, v) * dot(v, w) * dot(w, u))
    return strength[0] * (1 + 3 * cosines / product) / (product * m.sqrt(product))


def curvature(m, a, b, c):
    u, v, w = sub(b, a), sub(c, b), sub(c, a)
    n = cross(u, v)
    return 4 * dot(n, n) / (dot(u, u) * dot(v, v) * dot(w, w))


def rotated(q, v):
    """By a quaternion of length 1, as glam does: w² v − u² v + 2 (u · v) u + 2 w u × v costs more than this."""
    u, w = q[:3], q[3]
    once = scale(2, cross(u, v))
    return add(v, add(scale(w, once), cross(u, once)))


def carried(q, v):
    """By a quaternion of any length, which is that formula."""
    u, w = q[:3], q[3]
    once = add(scale(2 * dot(u, v), u), scale(2 * w, cross(u, v)))
    return add(scale(w * w - dot(u, u), v), once)


def turned(m, axis, v):
    """By a rotation vector."""
    square = dot(axis, axis)
    r = m.sqrt(square)
    sine, cosine = m.sin(r), m.cos(r)
    aside, along = cross(axis, v), dot(axis, v) * (1 - cosine) / square
    return [cosine * x + sine / r * y + along * z for x, y, z in zip(v, aside, axis)]


def attitude(m, q, gravity, north, felt, shown):
    norm = m.sqrt(dot(q, q) + q[3] * q[3])
    unit = [x / norm for x in q]
    down, ahead = sub(rotated(unit, gravity), felt), sub(rotated(unit, north), shown)
    return dot(down, down) + dot(ahead, ahead)


def rolling_shutter(m, turn, shift, point, row, seen):
    p = add(turned(m, scale(row[0], turn), point), scale(row[0], shift))
    x, y = p[0] / p[2] - seen[0], p[1] / p[2] - seen[1]
    return x * x + y * y


def pan_and_tilt(m, pan, tilt, arm, eye, target):
    (s, c), (t, d) = [(m.sin(angle[0]), m.cos(angle[0])) for angle in (pan, tilt)]

    def turn(v):
        return [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]]

    def nod(v):
        return [d * v[0] + t * v[2], v[1], d * v[2] - t * v[0]]

    way = sub(target, turn(add(arm, nod(eye))))
    return 1 - dot(turn(nod([1, 0, 0])), way) / m.sqrt(dot(way, way))


def contact(m, turn, shift, a, b, normal, offset):
    first = dot(normal, add(turned(m, turn, a), shift)) - offset[0]
    second = dot(normal, add(turned(m, turn, b), shift)) - offset[0]
    return first * first + second * second


def transfer(m, x, y, z, point, seen):
    p = [*point, 1]
    depth = dot(z, p)
    u, v = dot(x, p) / depth - seen[0], dot(y, p) / depth - seen[1]
    return u * u + v * v


def lens(m, p, k, focal, seen):
    x, y = p[0] / p[2], p[1] / p[2]
    r2 = x * x + y * y
    radial = 1 + k[0] * r2 + k[1] * r2 * r2
    u = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x)
    v = y * radial + 2 * k[3] * x * y + k[2] * (r2 + 2 * y * y)
    u, v = focal[0] * u - seen[0], focal[0] * v - seen[1]
    return u * u + v * v


def preintegrated(m, q, v, w, shift, pull, time, gain, way):
    half, t = number(time[0], 1, 2), time[0]
    back = [-q[0], -q[1], -q[2], q[3]]
    faster = sub(carried(back, sub(sub(w, v), scale(t, pull))), gain)
    further = sub(carried(back, sub(sub(shift, scale(t, v)), scale(half * t * t, pull))), way)
    return dot(faster, faster) + dot(further, further)


def damped(m, a, b, va, vb, stiffness, damping, rest, wanted):
    way = sub(b, a)
    length = m.sqrt(dot(way, way))
    force = stiffness[0] * (length - rest[0]) + damping[0] * dot(sub(vb, va), way) / length
    return (force - wanted[0]) * (force - wanted[0])


def blended(m, p, large, small, center, radius, width):
    ring = m.sqrt(p[0] * p[0] + p[1] * p[1]) - large[0]
    torus = m.sqrt(ring * ring + p[2] * p[2]) - small[0]
    off = sub(p, center)
    ball = m.sqrt(dot(off, off)) - radius[0]
    apart = torus - ball
    return number(p[0], 1, 2) * (torus + ball - m.sqrt(apart * apart + width[0] * width[0]))


def planar_arm(m, shoulder, elbow, upper, lower, target):
    both = shoulder[0] + elbow[0]
    x = upper[0] * m.cos(shoulder[0]) + lower[0] * m.cos(both) - target[0]
    y = upper[0] * m.sin(shoulder[0]) + lower[0] * m.sin(both) - target[1]
    return x * x + y * y


def mixture(m, p, a, b, wide, narrow, share):
    (wide,), (narrow,), (share,) = wide, narrow, share
    half = number(wide, 1, 2)
    u, v = sub(p, a), sub(p, b)
    first = share / (wide * wide * wide) * m.exp(-half * dot(u, u) / (wide * wide))
    second = (1 - share) / (narrow * narrow * narrow) * m.exp(-half * dot(v, v) / (narrow * narrow))
    return -m.log(first + second)


def epipolar(m, turn, t, a, b):
    line = cross(t, turned(m, turn, a))
    e = dot(b, line)
    return e * e / (line[0] * line[0] + line[1] * line[1])


def flattened(m, p, mu, flattening, radius):
    r2 = dot(p, p)
    sine2 = p[2] * p[2] / r2
    bulge = flattening[0] * radius[0] * radius[0] / r2 * (number(r2, 3, 2) * sine2 - number(r2, 1, 2))
    return -mu[0] / m.sqrt(r2) * (1 - bulge)


def robust(m, q, shift, a, b, width):
    off = sub(add(carried(q, a), shift), b)
    square = dot(off, off)
    return square / (square + width[0] * width[0])


def arrivals(m, p, a, b, c, ab, ac):
    da, db, dc = [m.sqrt(dot(off, off)) for off in (sub(p, a), sub(p, b), sub(p, c))]
    u, v = da - db - ab[0], da - dc - ac[0]
    return u * u + v * v


def cart(m, angle, speed, force, cart, pole, length, pull, wanted):
    (angle,), (speed,), (force,), (cart,), (pole,), (length,), (pull,) = angle, speed, force, cart, pole, length, pull
    sine, cosine = m.sin(angle), m.cos(angle)
    below = cart + pole * sine * sine
    forth = (force + pole * sine * (length * speed * speed + pull * cosine)) / below
    back = -force * cosine - pole * length * speed * speed * cosine * sine - (cart + pole) * pull * sine
    u, v = forth - wanted[0], back / (length * below) - wanted[1]
    return u * u + v * v


def tetra(m, a, b, c, d, inv, mu, lam):
    e = [sub(b, a), sub(c, a), sub(d, a)]
    cols = [inv[0:3], inv[3:6], inv[6:9]]
    f = [[sum(e[k][i] * col[k] for k in range(3)) for i in range(3)] for col in cols]
    j = dot(f[0], cross(f[1], f[2]))
    half = number(a[0], 1, 2)
    sq = sum(dot(x, x) for x in f)
    return half * mu[0] * (sq - 3 - 2 * m.log(j)) + half * lam[0] * (j - 1) * (j - 1)


def odometry(m, x, y, heading, ox, oy, turned_, seen):
    s, c = m.sin(heading[0]), m.cos(heading[0])
    dx, dy = ox[0] - x[0], oy[0] - y[0]
    u, v, w = c * dx + s * dy - seen[0], c * dy - s * dx - seen[1], turned_[0] - heading[0] - seen[2]
    return u * u + v * v + w * w


def three_points(m, q, t, a, b, c, x, y, z):
    r = [sub(add(carried(q, p), t), w) for p, w in ((a, x), (b, y), (c, z))]
    return sum(dot(v, v) for v in r)


def camera(m, q, t, p, focal, seen):
    l = add(carried(q, p), t)
    u, v = focal[0] * l[0] / l[2] - seen[0], focal[0] * l[1] / l[2] - seen[1]
    return u * u + v * v


def rotor(m, q, v, thrust, mass, pull, drag, wanted):
    lift = carried(q, [0, 0, thrust[0]])
    a = sub(sub(add([x / mass[0] for x in lift], pull), scale(drag[0] * m.sqrt(dot(v, v)), v)), wanted)
    return dot(a, a)


def capsule(m, p, a, b, radius):
    pa, ba = sub(p, a), sub(b, a)
    h = dot(pa, ba) / dot(ba, ba)
    off = sub(pa, scale(h, ba))
    return m.sqrt(dot(off, off)) - radius[0]


def logits(m, x, y, z, wanted):
    e = [m.exp(v[0]) for v in (x, y, z)]
    s = e[0] + e[1] + e[2]
    r = [v / s - w for v, w in zip(e, wanted)]
    return dot(r, r)


def double_pendulum(m, one, two, ro, rt, m1, n1, l, k, g):
    (one,), (two,), (ro,), (rt,), (m1,), (n1,), (l,), (k,), (g,) = one, two, ro, rt, m1, n1, l, k, g
    half = number(one, 1, 2)
    kin = half * (m1 + n1) * l * l * ro * ro + half * n1 * k * k * rt * rt + n1 * l * k * ro * rt * m.cos(one - two)
    h = -(m1 + n1) * g * l * m.cos(one) - n1 * g * k * m.cos(two)
    return kin - h


def specular(m, roughness, light, view, normal, base):
    t = add(light, view)
    r = m.sqrt(dot(t, t))
    h = [x / r for x in t]
    nh, nl, nv, vh = dot(normal, h), dot(normal, light), dot(normal, view), dot(view, h)
    a2 = roughness[0] * roughness[0]
    k = nh * nh * (a2 - 1) + 1
    d = a2 / (k * k)
    o = 1 - vh
    f = base[0] + (1 - base[0]) * o * o * o * o * o
    g = 1 / ((nl + m.sqrt(a2 + (1 - a2) * nl * nl)) * (nv + m.sqrt(a2 + (1 - a2) * nv * nv)))
    return d * f * g


def area(m, a, b, c, rest):
    n = cross(sub(b, a), sub(c, a))
    x = number(a[0], 1, 2) * m.sqrt(dot(n, n)) - rest[0]
    return x * x


def volume(m, a, b, c, d, rest):
    x = dot(cross(sub(b, a), sub(c, a)), sub(d, a)) / 6 - rest[0]
    return x * x


def two_planes(m, turn, t, a, n, b, k):
    u, v = dot(n, add(turned(m, turn, a), t)), dot(k, add(turned(m, turn, b), t))
    return u * u / (1 + u * u) + v * v / (1 + v * v)


def mahalanobis(m, x, mean, cov):
    a, b, c, d, e, f = cov
    off = sub(x, mean)
    co = [[b * c - f * f, e * f - d * c, d * f - b * e], [e * f - d * c, a * c - e * e, d * e - a * f], [d * f - b * e, d * e - a * f, a * b - d * d]]
    det = a * co[0][0] + d * co[0][1] + e * co[0][2]
    half = number(x[0], 1, 2)
    return half * sum(off[i] * sum(co[i][j] * off[j] for j in range(3)) for i in range(3)) / det + half * m.log(det)


def spin_energy(m, q, w, inertia, wanted):
    r = sub(carried(q, [i * x for i, x in zip(inertia, w)]), wanted)
    return dot(r, r)


def relative(m, p, q, seen):
    u, w = [-x for x in p[:3]], p[3]
    v, z = q[:3], q[3]
    vec = add(add(scale(w, v), scale(z, u)), cross(u, v))
    r = sub(vec, seen[:3]) + [w * z - dot(u, v) - seen[3]]
    return sum(x * x for x in r)


def bicycle(m, x, y, yaw, speed, steer, base, dt, wanted):
    (x,), (y,), (yaw,), (speed,), (steer,), (base,), (dt,) = x, y, yaw, speed, steer, base, dt
    r = [x + dt * speed * m.cos(yaw) - wanted[0], y + dt * speed * m.sin(yaw) - wanted[1], yaw + dt * speed / base * m.tan(steer) - wanted[2]]
    return dot(r, r)


def morse(m, a, b, depth, width, rest):
    u = sub(a, b)
    e = 1 - m.exp(-width[0] * (m.sqrt(dot(u, u)) - rest[0]))
    return depth[0] * e * e


def stillinger(m, a, b, c, strength, gamma, cut):
    u, v = sub(a, b), sub(c, b)
    p, q = m.sqrt(dot(u, u)), m.sqrt(dot(v, v))
    k = dot(u, v) / (p * q) + number(a[0], 1, 3)
    return strength[0] * m.exp(gamma[0] / (p - cut[0]) + gamma[0] / (q - cut[0])) * k * k


def bending(m, a, b, c, d, rest):
    e = sub(b, a)
    n, k = cross(e, sub(c, a)), cross(sub(d, a), e)
    x = m.atan2(dot(cross(n, k), e) / m.sqrt(dot(e, e)), dot(n, k)) - rest[0]
    return x * x


def generalized_icp(m, turn, shift, a, b, w):
    r = sub(add(turned(m, turn, a), shift), b)
    wr = [sum(w[3 * k + i] * r[k] for k in range(3)) for i in range(3)]
    return dot(r, wr)


def corotated(m, f, mu, lam):
    a, c, b, d = f
    s = m.sqrt((a + d) * (a + d) + (c - b) * (c - b))
    j = a * d - b * c
    return mu[0] * (a * a + b * b + c * c + d * d - 2 * s + 2) + number(a, 1, 2) * lam[0] * (j - 1) * (j - 1)


def stvk(m, a, b, c, inv, mu, lam):
    p, q = sub(b, a), sub(c, a)
    u, v = add(scale(inv[0], p), scale(inv[1], q)), add(scale(inv[2], p), scale(inv[3], q))
    e, f, g = dot(u, u) - 1, dot(v, v) - 1, dot(u, v)
    return number(a[0], 1, 4) * mu[0] * (e * e + f * f + 2 * g * g) + number(a[0], 1, 8) * lam[0] * (e + f) * (e + f)


def angle_error(m, q, wanted):
    n = m.sqrt(sum(x * x for x in q))
    v, z = [x / n for x in q[:3]], q[3] / n
    u, w = [-x for x in wanted[:3]], wanted[3]
    vec = add(add(scale(w, v), scale(z, u)), cross(u, v))
    return 2 * m.atan2(m.sqrt(dot(vec, vec)), w * z - dot(u, v))


def drag(m, p, v, wind, sc, density, k):
    rho = density[0] * m.exp(-p[2] / sc[0])
    off = sub(v, wind)
    return k[0] * rho * m.sqrt(dot(off, off)) * dot(off, v)


def radar(m, az, el, r, at, seen):
    (az,), (el,), (r,) = az, el, r
    p = sub(add([r * m.cos(el) * m.cos(az), r * m.cos(el) * m.sin(az), r * m.sin(el)], at), seen)
    return dot(p, p)


def ray_sphere(m, o, d, c, r):
    off = sub(o, c)
    b = dot(off, d)
    return -b - m.sqrt(b * b - dot(off, off) + r[0] * r[0])


def spatial_arm(m, one, two, three, upper, lower, target):
    (one,), (two,), (three,), (upper,), (lower,) = one, two, three, upper, lower
    reach = upper * m.cos(two) + lower * m.cos(two + three)
    p = sub([reach * m.cos(one), reach * m.sin(one), upper * m.sin(two) + lower * m.sin(two + three)], target)
    return dot(p, p)


def dipoles(m, a, b, place):
    r2 = dot(place, place)
    return (dot(a, b) - 3 * dot(a, place) * dot(b, place) / r2) / (r2 * m.sqrt(r2))


def tracking(m, x, v, force, mass, dt, wanted, effort):
    a = [f / mass[0] for f in force]
    nx = [xi + dt[0] * vi + number(xi, 1, 2) * dt[0] * dt[0] * ai - w for xi, vi, ai, w in zip(x, v, a, wanted)]
    sp = [vi + dt[0] * ai for vi, ai in zip(v, a)]
    sq = lambda z: sum(t * t for t in z)
    return sq(nx) + 0.1 * sq(sp) + effort[0] * sq(force)


def double_sphere(m, p, xi, alpha, focal, center, seen):
    d1 = m.sqrt(dot(p, p))
    z = xi[0] * d1 + p[2]
    d2 = m.sqrt(p[0] * p[0] + p[1] * p[1] + z * z)
    depth = alpha[0] * d2 + (1 - alpha[0]) * z
    u = focal[0] * p[0] / depth + center[0] - seen[0]
    v = focal[1] * p[1] / depth + center[1] - seen[1]
    return u * u + v * v


def inverse_depth(m, q, t, azimuth, elevation, rho, seen):
    sa, ca, se, ce = m.sin(azimuth[0]), m.cos(azimuth[0]), m.sin(elevation[0]), m.cos(elevation[0])
    p = add(carried(q, [ce * sa, -se, ce * ca]), scale(rho[0], t))
    u, v = p[0] / p[2] - seen[0], p[1] / p[2] - seen[1]
    return u * u + v * v


def symmetric(m, turn, t, a, b, na, nb):
    back = turned(m, [-x for x in turn], b)
    r = dot(add(sub(turned(m, turn, a), back), t), add(na, nb))
    return m.log(1 + r * r)


def ndt(m, x, y, yaw, point, mean, information):
    s, c = m.sin(yaw[0]), m.cos(yaw[0])
    dx = c * point[0] - s * point[1] + x[0] - mean[0]
    dy = s * point[0] + c * point[1] + y[0] - mean[1]
    xx, xy, yy = information
    square = xx * dx * dx + 2 * xy * dx * dy + yy * dy * dy
    return -m.exp(-number(dx, 1, 2) * square)


def range_lever(m, p, q, lever, beacon, range_, width):
    off = sub(add(p, carried(q, lever)), beacon)
    e = (m.sqrt(dot(off, off)) - range_[0]) / width[0]
    return m.log(1 + e * e)


def wheel_arc(m, left, right, base, tl, tr, pose, seen):
    (left,), (right,), (base,), (tl,), (tr,) = left, right, base, tl, tr
    forward = number(left, 1, 2) * (left * tl + right * tr)
    turn = (right * tr - left * tl) / base
    radius = forward / turn
    x = pose[0] + radius * (m.sin(pose[2] + turn) - m.sin(pose[2])) - seen[0]
    y = pose[1] - radius * (m.cos(pose[2] + turn) - m.cos(pose[2])) - seen[1]
    heading = pose[2] + turn - seen[2]
    return x * x + y * y + heading * heading


def gyro_step(m, q, following, bias, rate, dt):
    w = sub(rate, bias)
    u, s = q[:3], q[3]
    slope = add(scale(s, w), cross(u, w)) + [-dot(u, w)]
    half = number(w[0], 1, 2) * dt[0]
    off = [n - (a + b * half) for n, a, b in zip(following, q, slope)]
    return sum(x * x for x in off)


def magnetometer(m, hard, soft, raw, field):
    xx, yy, zz, xy, xz, yz = soft
    d = sub(raw, hard)
    f = [dot([xx, xy, xz], d), dot([xy, yy, yz], d), dot([xz, yz, zz], d)]
    e = m.sqrt(dot(f, f)) - field[0]
    return e * e


def rod(m, a, b, c, rest, stiffness):
    e, f = sub(b, a), sub(c, b)
    below = m.sqrt(dot(e, e)) * m.sqrt(dot(f, f)) + dot(e, f)
    off = sub([2 * x / below for x in cross(e, f)], rest)
    return number(a[0], 1, 2) * stiffness[0] * dot(off, off)


def mooney(m, f, c1, c2, bulk):
    x, y, z = f[0:3], f[3:6], f[6:9]
    (c1,), (c2,), (bulk,) = c1, c2, bulk
    j = dot(x, cross(y, z))
    xx, yy, zz, xy, yz, zx = dot(x, x), dot(y, y), dot(z, z), dot(x, y), dot(y, z), dot(z, x)
    half = number(xx, 1, 2)
    first = xx + yy + zz
    second = half * (first * first - (xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx)))
    volume = half * bulk * (j - 1) * (j - 1)
    return c1 * (first - 3) + c2 * (second - 3) - 2 * (c1 + 2 * c2) * m.log(j) + volume


def strand(m, a, b, c, rest, stretch, bend):
    u, v = sub(b, a), sub(c, b)
    first, second = m.sqrt(dot(u, u)) - rest[0], m.sqrt(dot(v, v)) - rest[0]
    bent = add(sub(a, scale(2, b)), c)
    half = number(a[0], 1, 2)
    return half * stretch[0] * (first * first + second * second) + half * bend[0] * dot(bent, bent)


def balloon(m, a, b, c, tension, pressure, rest):
    n = cross(sub(b, a), sub(c, a))
    skin = number(a[0], 1, 2) * m.sqrt(dot(n, n))
    volume = dot(a, cross(b, c)) / 6
    return tension[0] * skin - pressure[0] * rest[0] * m.log(volume / rest[0])


def anisotropic(m, light, ax, ay, view, x, y, normal):
    total = add(light, view)
    r = m.sqrt(dot(total, total))
    half = [t / r for t in total]
    hx, hy, hn = dot(x, half) / ax[0], dot(y, half) / ay[0], dot(normal, half)
    s = hx * hx + hy * hy + hn * hn
    return 1 / (math.pi * ax[0] * ay[0] * s * s)


def carved(m, p, radii, center, radius, width):
    a = [x / r for x, r in zip(p, radii)]
    b = [x / (r * r) for x, r in zip(p, radii)]
    k0, k1 = m.sqrt(dot(a, a)), m.sqrt(dot(b, b))
    ellipsoid = k0 * (k0 - 1) / k1
    off = sub(p, center)
    ball = radius[0] - m.sqrt(dot(off, off))
    apart = ellipsoid - ball
    return number(p[0], 1, 2) * (ellipsoid + ball + m.sqrt(apart * apart + width[0] * width[0]))


def harmonics(m, direction, l):
    r = m.sqrt(dot(direction, direction))
    x, y, z = [d / r for d in direction]
    return (
        0.282095 * l[0]
        + 0.488603 * (l[1] * y + l[2] * z + l[3] * x)
        + 1.092548 * (l[4] * x * y + l[5] * y * z + l[7] * x * z)
        + 0.315392 * l[6] * (3 * z * z - 1)
        + 0.546274 * l[8] * (x * x - y * y)
    )


def blur(m, focal, focus, eye, axis, near, far, stop):
    (focal,), (focus,), (stop,) = focal, focus, stop
    aperture = focal / stop
    one, two = dot(axis, sub(near, eye)), dot(axis, sub(far, eye))
    first = aperture * focal * (one - focus) / (one * (focus - focal))
    second = aperture * focal * (two - focus) / (two * (focus - focal))
    return first * first + second * second


def crane(m, speed, rope, hoist, angle, rate, trolley, load, pull):
    (speed,), (rope,), (hoist,), (angle,), (rate,), (trolley,), (load,), (pull,) = (
        speed, rope, hoist, angle, rate, trolley, load, pull
    )
    s, c = m.sin(angle), m.cos(angle)
    half = number(speed, 1, 2)
    vx, vy = speed + hoist * s + rope * rate * c, hoist * c - rope * rate * s
    kinetic = half * trolley * speed * speed + half * load * (vx * vx + vy * vy)
    return kinetic + load * pull * rope * c


def quadrotor(m, roll, pitch, yaw, thrust, mass, pull, wanted):
    (sr, cr), (sp, cp), (sy, cy) = [(m.sin(x[0]), m.cos(x[0])) for x in (roll, pitch, yaw)]
    push = thrust[0] / mass[0]
    ax = push * (cr * sp * cy + sr * sy) - wanted[0]
    ay = push * (cr * sp * sy - sr * cy) - wanted[1]
    az = push * cr * cp - pull[0] - wanted[2]
    return ax * ax + ay * ay + az * az


def two_link(m, elbow, rates, acc, shoulder, masses, lengths, pull):
    (elbow,), (shoulder,), (pull,), (m1, m2), (l1, l2) = elbow, shoulder, pull, masses, lengths
    inertia = m2 * l2 * l2
    coupling, h = m2 * l1 * l2 * m.cos(elbow), m2 * l1 * l2 * m.sin(elbow)
    m11, m12 = (m1 + m2) * l1 * l1 + inertia + 2 * coupling, inertia + coupling
    g2 = m2 * l2 * pull * m.cos(shoulder + elbow)
    g1 = (m1 + m2) * l1 * pull * m.cos(shoulder) + g2
    t1 = m11 * acc[0] + m12 * acc[1] - h * (2 * rates[0] * rates[1] + rates[1] * rates[1]) + g1
    t2 = m12 * acc[0] + inertia * acc[1] + h * rates[0] * rates[0] + g2
    return t1 * t1 + t2 * t2


def ions(m, a, b, wall, rho, c6, charge, damping):
    u = sub(a, b)
    r2 = dot(u, u)
    r = m.sqrt(r2)
    buckingham = wall[0] * m.exp(-r / rho[0]) - c6[0] / (r2 * r2 * r2)
    damped = 1 - (1 + number(r, 1, 2) * damping[0] * r) * m.exp(-damping[0] * r)
    return buckingham + charge[0] / r * damped


def rotamer(m, a, b, c, d, k):
    n, o = cross(sub(b, a), sub(c, b)), cross(sub(c, b), sub(d, c))
    x = dot(n, o) / (m.sqrt(dot(n, n)) * m.sqrt(dot(o, o)))
    return k[0] + k[1] * x + k[2] * x * x + k[3] * x * x * x


def stretch_bend(m, a, b, c, k, rest, angle):
    u, v = sub(a, b), sub(c, b)
    p, q = m.sqrt(dot(u, u)), m.sqrt(dot(v, v))
    theta = m.acos(dot(u, v) / (p * q))
    return (k[0] * (p - rest[0]) + k[1] * (q - rest[1])) * (theta - angle[0])


def student(m, x, mean, scales, freedom):
    z = [a / s for a, s in zip(sub(x, mean), scales)]
    logs = m.log(scales[0]) + m.log(scales[1]) + m.log(scales[2])
    return number(x[0], 1, 2) * (freedom[0] + 3) * m.log(1 + dot(z, z) / freedom[0]) + logs


def logistic(m, w, bias, a, b, la, lb, ridge):
    ma, mb = la[0] * (dot(w, a) + bias[0]), lb[0] * (dot(w, b) + bias[0])
    return m.log(1 + m.exp(-ma)) + m.log(1 + m.exp(-mb)) + number(ma, 1, 2) * ridge[0] * dot(w, w)


def solid_angle(m, a, b, c):
    la, lb, lc = [m.sqrt(dot(v, v)) for v in (a, b, c)]
    below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    return 2 * m.atan2(dot(a, cross(b, c)), below)


def radius_ratio(m, a, b, c):
    u, v, w = sub(b, a), sub(c, b), sub(a, c)
    lu, lv, lw = [m.sqrt(dot(x, x)) for x in (u, v, w)]
    n = cross(u, v)
    area = number(a[0], 1, 2) * m.sqrt(dot(n, n))
    inner = 2 * area / (lu + lv + lw)
    outer = lu * lv * lw / (4 * area)
    return inner / outer


def cotangents(m, a, b, c, values):
    u, v, w = sub(c, b), sub(a, c), sub(b, a)
    n = cross(w, v)
    double = m.sqrt(dot(n, n))
    at = [-dot(w, v) / double, -dot(u, w) / double, -dot(v, u) / double]
    x, y, z = values[1] - values[2], values[2] - values[0], values[0] - values[1]
    return number(a[0], 1, 4) * (at[0] * x * x + at[1] * y * y + at[2] * z * z)


def bezier(m, a, b, c, d, t, target, speed):
    t = t[0]
    s = 1 - t
    place = add(add(scale(s * s * s, a), scale(3 * s * s * t, b)), add(scale(3 * s * t * t, c), scale(t * t * t, d)))
    velocity = add(add(scale(3 * s * s, sub(b, a)), scale(6 * s * t, sub(c, b))), scale(3 * t * t, sub(d, c)))
    off = sub(place, target)
    fast = m.sqrt(dot(velocity, velocity)) - speed[0]
    return dot(off, off) + fast * fast


def blend_turn(m, p, q, t, v, wanted):
    r = add(scale(1 - t[0], p), scale(t[0], q))
    norm = m.sqrt(dot(r, r) + r[3] * r[3])
    off = sub(rotated([x / norm for x in r], v), wanted)
    return dot(off, off)


def conic(m, a, b, c, weight, t, target):
    t = t[0]
    s = 1 - t
    i, j, k = s * s, 2 * weight[0] * s * t, t * t
    off = sub([(i * x + j * y + k * z) / (i + j + k) for x, y, z in zip(a, b, c)], target)
    return off[0] * off[0] + off[1] * off[1]


SIZES = {"DQuat": 4, "f64": 1, "DVec2": 2, "DVec3": 3, "DMat2": 4, "DMat3": 9, "[f64; 3]": 3, "[f64; 4]": 4, "[f64; 6]": 6,
         "[f64; 9]": 9}


def signatures():
    """Of each function: what derivatives are by, and its arguments with their sizes."""
    for wrt, name, arguments in re.findall(r"wrt\((.*?)\)\)\]\npub fn (\w+)\((.*?)\) ->", OBJECTIVES.read_text(), re.S):
        pairs = re.findall(r"(\w+): (\[f64; \d\]|\w+)", arguments)
        yield name, wrt.split(", "), [(argument, SIZES[ty]) for argument, ty in pairs]


def power(n):
    """The fewest multiplications of a whole power up to 16."""
    return {1: 0, 2: 1, 3: 2, 4: 2, 5: 3, 6: 3, 7: 4, 8: 3, 9: 4, 10: 4, 11: 5, 12: 4}.get(n, 2 * n.bit_length() - 2)


def of_product(factors, below):
    """The operations of a product of these factors, of which so many are divided by."""
    if below == len(factors):
        return len(factors) - 1
    # Of a⁻¹ b the division is counted in a⁻¹, and stands for the product.
    return len(factors) - 1 - below + max(below - 1, 0)


def of_power(exponent):
    """The operations of a rational power."""
    below = 1 if exponent < 0 else 0
    exponent = abs(exponent)
    if exponent.q == 1:
        return power(int(exponent)) + below
    if exponent.q == 2:
        return 1 + (power(exponent.p) if exponent.p > 1 else 0) + below
    raise ValueError(exponent)


def of_sympy(expression):
    """The operations of one expression without common parts."""
    if expression.is_Atom:
        return 0
    inner = sum(of_sympy(part) for part in expression.args)
    if expression.is_Add:
        return inner + len(expression.args) - 1
    if expression.is_Mul:
        # −1 is free; every factor below the line is divided by, or multiplied with others below it.
        factors = [part for part in expression.args if part != -1]
        below = [part for part in factors if part.is_Pow and part.exp.could_extract_minus_sign() and part.exp.is_number]
        return inner + of_product(factors, len(below))
    if expression.is_Pow and expression.exp.is_Rational:
        return inner + of_power(expression.exp)
    if isinstance(expression, sympy.Function):
        return inner
    raise ValueError(expression)


def counted_sympy(objective, wrt, arguments):
    values = [list(sympy.symbols(f"{name}_0:{size}", real=True)) for name, size in arguments]
    value = objective(Maths(sympy), *values)
    by = [x for (name, _), own in zip(arguments, values) if name in wrt for x in own]
    outputs = [value] + [sympy.diff(value, x) for x in by]
    best = None
    for optimizations in (None, "basic"):
        for order in ("canonical", "none"):
            parts, results = sympy.cse(outputs, optimizations=optimizations, order=order)
            total = sum(of_sympy(part) for _, part in parts) + sum(of_sympy(result) for result in results)
            best = total if best is None else min(best, total)
    return best


def counted_casadi(objective, wrt, arguments):
    values = [[casadi.SX.sym(f"{name}{i}") for i in range(size)] for name, size in arguments]
    value = objective(Maths(casadi), *values)
    by = casadi.vertcat(*[x for (name, _), own in zip(arguments, values) if name in wrt for x in own])
    inputs = casadi.vertcat(*[x for own in values for x in own])
    ones = {"OP_ADD", "OP_SUB", "OP_MUL", "OP_DIV", "OP_SQRT", "OP_SQ", "OP_TWICE", "OP_INV"}
    codes = {getattr(casadi, name) for name in ones}
    best = None
    for gradient in (casadi.gradient(value, by), casadi.jtimes(value, by, casadi.DM.eye(by.numel())).T):
        for shared in (False, True):
            f = casadi.Function("f", [inputs], [value, gradient], {"cse": shared})
            total = sum(f.instruction_id(i) in codes for i in range(f.n_instructions()))
            best = total if best is None else min(best, total)
    return best


class Wrenfold:
    """The functions of wrenfold, by the names that the others have."""

    sqrt, sin, cos, exp, log = map(staticmethod, (sym.sqrt, sym.sin, sym.cos, sym.exp, sym.log))
    atan2, tan, acos = map(staticmethod, (sym.atan2, sym.tan, sym.acos))


class Symengine:
    """The same of SymEngine."""

    sqrt, sin, cos, exp, log = map(
        staticmethod, (symengine.sqrt, symengine.sin, symengine.cos, symengine.exp, symengine.log)
    )
    atan2, tan, acos = map(staticmethod, (symengine.atan2, symengine.tan, symengine.acos))


def code_wrenfold(objective, wrt, arguments):
    names = [f"{n}{i}" for n, s in arguments for i in range(s)]

    def body(*xs):
        rest = iter(xs)
        values = [[next(rest) for _ in range(s)] for _, s in arguments]
        v = objective(Maths(Wrenfold), *values)
        by = [x for (n, _), own in zip(arguments, values) if n in wrt for x in own]
        return [cg.OutputArg(v, name="o")] + [cg.OutputArg(v.diff(x), name=f"o{k}") for k, x in enumerate(by)]

    space = {"ta": ta, "body": body}
    exec(f"def f({', '.join(n + ': ta.FloatScalar' for n in names)}):\n    return body({', '.join(names)})", space)
    r = cg.generate_function(space["f"], cg.PythonGenerator())
    return r if isinstance(r, str) else r.code


def counted_wrenfold(objective, wrt, arguments):
    count = 0
    for node in ast.walk(ast.parse(code_wrenfold(objective, wrt, arguments))):
        if isinstance(node, ast.BinOp):
            if isinstance(node.op, ast.Pow):
                raise ValueError("power")
            count += 1
        if isinstance(node, ast.Call):
            f = node.func.attr if isinstance(node.func, ast.Attribute) else node.func.id
            if f == "pow":
                raise ValueError("power")
            count += f == "sqrt"
    return count


def of_symengine(expression):
    """As `of_sympy`, by what SymEngine tells of an expression."""
    if not expression.args:
        return 0
    inner = sum(of_symengine(part) for part in expression.args)
    if expression.is_Add:
        return inner + len(expression.args) - 1
    if expression.is_Mul:
        factors = [part for part in expression.args if part != -1]
        below = [part for part in factors if part.is_Pow and part.args[1].is_number and part.args[1] < 0]
        return inner + of_product(factors, len(below))
    if expression.is_Pow and expression.args[1].is_number:
        return of_symengine(expression.args[0]) + of_power(sympy.Rational(str(expression.args[1])))
    return inner


def counted_symengine(objective, wrt, arguments):
    """The best of some ways to name the inputs, by which SymEngine orders its terms."""
    best = None
    for mark in ("_", "x", "_a", "y"):
        values = [list(symengine.symbols(f"{n}{mark}0:{s}")) for n, s in arguments]
        v = objective(Maths(Symengine), *values)
        by = [x for (n, _), own in zip(arguments, values) if n in wrt for x in own]
        parts, results = symengine.cse([v] + [symengine.diff(v, x) for x in by])
        total = sum(of_symengine(e) for _, e in parts) + sum(of_symengine(e) for e in results)
        best = total if best is None else min(best, total)
    return best


def counted_aim(aim, name):
    command = [aim, "generate", str(OBJECTIVES), "--function", name, "--lang", "c"]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return int(re.search(r"(\d+) operations", text)[1])


def main():
    aim, *page = sys.argv[1:]
    lines = ["| value and first derivatives | `aim` | SymPy | CasADi | wrenfold | SymEngine | ratio |", "|---|---|---|---|---|---|---|"]
    ratios = []
    for name, wrt, arguments in signatures():
        objective = globals()[name]
        own = counted_aim(aim, name)
        counts = (counted_sympy, counted_casadi, counted_wrenfold, counted_symengine)
        others = [counted(objective, wrt, arguments) for counted in counts]
        ratios.append(own / min(others))
        columns = [name.replace("_", " "), own, *others, f"{ratios[-1]:.2f}"]
        lines.append(f"| {' | '.join(map(str, columns))} |")
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    lines.append(f"| geometric mean | | | | | | {mean:.2f} |")
    table = "\n".join(lines)
    print(table)
    if page and table not in Path(page[1]).read_text():
        sys.exit(f"{page[1]} has another table")


main()

//! Nested loops that remain loops, and elements of slices selected by values.

#[aim::differentiate(check = true)]
mod functions {
    use aim::glam::DVec3;

    /// The energy of every pair, each counted once.
    #[differentiate(wrt(width, depth, shift))]
    pub(super) fn pairs(width: f64, depth: f64, shift: DVec3, atoms: &[DVec3]) -> f64 {
        let mut energy = 0.0;
        for i in 0..atoms.len() {
            for j in i + 1..atoms.len() {
                let apart = (atoms[i] - atoms[j] + shift * (j as f64)).length_squared() + 0.1;
                let part = (width * width / apart).powi(3);
                energy += 4.0 * depth * (part * part - part);
            }
        }
        energy
    }

    /// The energy of springs whose ends are given by indices.
    #[differentiate(wrt(stiffness, stretch))]
    pub(super) fn springs(stiffness: f64, stretch: DVec3, points: &[DVec3], edges: &[[usize; 2]]) -> f64 {
        edges
            .iter()
            .map(|&[from, to]| {
                let edge = (points[to] - points[from]) * stretch;
                0.5 * stiffness * (edge.length() - 1.0).powi(2)
            })
            .sum()
    }

    #[derive(Clone, Copy)]
    pub(super) struct Part {
        pub(super) weight: f64,
        pub(super) mean: f64,
        pub(super) is_used: bool,
    }

    /// A nested sum, by iterators.
    #[differentiate(wrt(shift, width))]
    pub(super) fn mixture(shift: f64, width: f64, samples: &[f64], parts: &[Part]) -> f64 {
        let density = |x: f64, part: &Part| part.weight * (-0.5 * ((x - part.mean - shift) / width).powi(2)).exp();
        -samples
            .iter()
            .map(|&x| {
                let used = parts.iter().filter(|part| part.is_used);
                (1e-3 + used.map(|part| density(x, part)).sum::<f64>() / width).ln()
            })
            .sum::<f64>()
    }

    /// Linear interpolation between the entries of a table.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the place in the table is meant")]
    #[differentiate(wrt(x))]
    pub(super) fn interpolated(x: f64, table: &[f64]) -> f64 {
        let last = table.len() - 1;
        let at = (x.max(0.0) as usize).min(last - 1);
        let part = x - at as f64;
        table[at] * (1.0 - part) + table[at + 1] * part
    }

    /// Newton's method for each sample.
    #[differentiate(wrt(a, e))]
    pub(super) fn orbits(a: f64, e: f64, times: &[f64], seen: &[f64]) -> f64 {
        // Limit e, so that the iteration converges.
        let e = 0.8 * e / (1.0 + e.abs());
        let mut sum = 0.0;
        for (time, seen) in times.iter().zip(seen) {
            let mut x = *time;
            loop {
                let step = (x - e * x.sin() - time) / (1.0 - e * x.cos());
                x -= step;
                if step.abs() < 1e-11 {
                    break;
                }
            }
            sum += (a * (x.cos() - e) - seen).powi(2);
        }
        sum / times.len() as f64
    }

    /// Slices traversed backwards, in steps, in chunks, and from both ends.
    #[differentiate(wrt(x, k))]
    pub(super) fn ways(x: f64, k: f64, numbers: &[f64]) -> f64 {
        let polynomial = numbers.iter().rev().fold(0.0, |sum, c| sum * x + c);
        let mut sum = polynomial;
        for i in (0..numbers.len()).rev().step_by(2) {
            sum += k * numbers[i] * x - sum * 0.125;
        }
        for part in numbers.chunks_exact(3) {
            sum += (part[0] * x - part[1] * k) * part[2];
        }
        for (a, b) in numbers[1..].iter().zip(&numbers[..numbers.len() - 1]) {
            sum += (a - b * x).powi(2);
        }
        let ends = numbers.first().unwrap_or(&0.0) * x + numbers.last().unwrap_or(&0.0) * k;
        sum + ends * numbers.get(2).copied().unwrap_or(k * k)
    }

    /// Pairs with an offset index, blocks of any size, and a prefix.
    #[differentiate(wrt(a))]
    pub(super) fn blocks(a: f64, numbers: &[f64], size: usize) -> f64 {
        let mut sum = 0.0;
        for (i, x) in numbers.iter().enumerate() {
            for (j, y) in numbers.iter().enumerate().skip(i + 1) {
                sum += (x * a - y).powi(2) * (j - i) as f64;
            }
        }
        for block in numbers.chunks(size.max(1)) {
            let mean = block.iter().sum::<f64>() / block.len() as f64;
            sum += block.iter().map(|x| (x - mean * a).powi(2)).sum::<f64>() * block[0];
        }
        let turned = numbers.iter().map(|x| x * a).rev().enumerate().step_by(2);
        let begins = numbers.iter().take_while(|x| **x * a < 1.5).map(|x| x * a).sum::<f64>();
        let roots = numbers.iter().map_while(|x| if *x > -0.9 { Some((x + 1.0).ln() * a) } else { None });
        sum + turned.map(|(k, x)| k as f64 * x.sin()).sum::<f64>() + begins + roots.fold(a, |t, x| t * 0.5 + x)
    }

    /// Iterations that start from the results of the previous inner loop, and two inner loops per iteration.
    #[differentiate(wrt(gain, bias))]
    pub(super) fn layers(gain: f64, bias: f64, weights: &[f64], depth: usize) -> [f64; 2] {
        let (mut x, mut most) = (bias, 0.0_f64);
        for layer in 0..depth {
            let mut sum = bias * x;
            for (k, weight) in weights.iter().enumerate() {
                if (k + layer) % 3 == 2 {
                    continue;
                }
                sum += weight * (gain * x + k as f64 * 0.125).tanh();
            }
            let mean = weights.iter().map(|weight| weight * sum).sum::<f64>() / (1.0 + weights.len() as f64);
            x = 0.5 * x + mean.sin();
            most = most.max(x);
        }
        [x, most]
    }

    /// Closures with side effects in lazy iterators, and searches that end early.
    #[differentiate(wrt(a))]
    pub(super) fn sought(a: f64, numbers: &[f64]) -> f64 {
        let mut sum = a;
        let squares: f64 = numbers
            .iter()
            .map(|x| {
                sum += a * x;
                sum * sum
            })
            .take(3)
            .sum();
        let mut asked = 0;
        let any = numbers.iter().any(|x| {
            asked += 1;
            a * x > 1.0
        });
        let place = numbers.iter().position(|x| x * a > 0.5).map_or(-1.0, |place| place as f64);
        let found = numbers.iter().find(|x| **x < 0.0).map_or(a * a, |x| x * a * 0.5);
        let most = numbers.iter().map(|x| (x - a).powi(2)).max_by(|x, y| x.total_cmp(y)).unwrap_or(a);
        let least = numbers.iter().copied().filter(|x| *x != 0.25).reduce(f64::min).map_or(0.0, |x| x * a);
        let roots = numbers.iter().filter_map(|x| if *x > 0.0 { Some(x.sqrt() * a) } else { None });
        let made = roots.reduce(|_, last| last);
        let rest = if any { asked as f64 * a } else { sum };
        squares + place * a + found + most + least + made.unwrap_or(0.125) + rest
    }

    /// Two kinds of exits from an inner loop.
    #[differentiate(wrt(a))]
    pub(super) fn searched(a: f64, rows: &[f64], columns: &[f64]) -> f64 {
        let mut sum = a;
        for row in rows {
            for column in columns {
                let product = row * column * a;
                if product > 2.0 {
                    return sum * product;
                }
                if product < -1.0 {
                    break;
                }
                sum += product;
            }
            sum *= 0.75;
        }
        sum
    }

    /// Exits from an inner loop to the enclosing one, and with a value.
    #[differentiate(wrt(a))]
    pub(super) fn left(a: f64, rows: &[f64], columns: &[f64]) -> f64 {
        let (mut sum, mut last) = (0.0, a);
        'rows: for row in rows {
            sum += row * a;
            for column in columns {
                last = row * column * a;
                if last > 1.5 {
                    last *= 0.5;
                    sum += last;
                    continue 'rows;
                }
                if last < -2.0 {
                    sum -= 0.25 * last;
                    break 'rows;
                }
                if last < -0.7 {
                    break;
                }
                sum += 0.125 * last * last;
            }
            sum *= 0.9;
        }
        let mut x = a;
        let root = loop {
            let next = 0.5 * (x + (a * a + 2.0) / x);
            if (next - x).abs() < 1e-9 {
                break next + 0.5 * ((a * a + 2.0) / next - next);
            }
            x = next;
        };
        sum + last * root
    }

    /// Three nested loops, the innermost of which is unrolled.
    #[differentiate(wrt(angle))]
    pub(super) fn grid(angle: f64, values: &[f64], columns: usize) -> f64 {
        if columns < 3 || values.len() < 3 * columns {
            return angle;
        }
        let rows = values.len() / columns;
        let mut sum = 0.0;
        for i in 1..rows - 1 {
            for j in 1..columns - 1 {
                for (k, (di, dj)) in [(0, 1), (1, 0), (2, 1), (1, 2)].into_iter().enumerate() {
                    let neighbour = values[(i + di - 1) * columns + (j + dj - 1)];
                    sum += (neighbour - values[i * columns + j]) * (angle * (k as f64 + 1.0)).cos();
                }
            }
        }
        sum * sum
    }

    fn nearest(x: f64, centres: &[f64]) -> usize {
        let (mut best, mut distance) = (0, f64::INFINITY);
        for (k, centre) in centres.iter().enumerate() {
            if (centre - x).abs() < distance {
                (best, distance) = (k, (centre - x).abs());
            }
        }
        best
    }

    /// A loop in a function that is called in every iteration.
    #[differentiate(wrt(scale))]
    pub(super) fn clustered(scale: f64, samples: &[f64], centres: &[f64]) -> f64 {
        samples.iter().map(|x| (scale * x - centres[nearest(scale * x, centres)]).powi(2)).sum()
    }
}

use aim::glam::DVec3;

use crate::kept::{assert_near, difference};
use functions::Part;

#[test]
fn every_pair() {
    let atoms: Vec<DVec3> = (0..6).map(|k| DVec3::new(f64::from(k).sin(), f64::from(k * k) * 0.2, 0.3)).collect();
    let shift = DVec3::new(0.1, -0.2, 0.05);
    for n in [0, 1, 2, 6] {
        let atoms = &atoms[..n];
        let (value, (by_width, by_depth, by_shift)) = functions::pairs_gradient(0.9, 0.4, shift, atoms);
        assert_near(value, functions::pairs(0.9, 0.4, shift, atoms));
        assert_near(by_width, difference(|w| functions::pairs(w, 0.4, shift, atoms), 0.9));
        assert_near(by_depth, difference(|d| functions::pairs(0.9, d, shift, atoms), 0.4));
        let along = |axis: DVec3| difference(|t| functions::pairs(0.9, 0.4, shift + t * axis, atoms), 0.0);
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            assert_near(by_shift.dot(axis), along(axis));
        }
    }
}

#[test]
fn elements_that_are_chosen() {
    let points = [DVec3::ZERO, DVec3::new(1.0, 0.5, 0.2), DVec3::new(-0.3, 1.0, 2.0), DVec3::ONE];
    let edges = [[0, 1], [3, 2], [1, 3], [2, 0]];
    let stretch = DVec3::new(1.1, 0.8, 1.2);
    let (value, (by_stiffness, by_stretch)) = functions::springs_gradient(2.0, stretch, &points, &edges);
    assert_near(value, functions::springs(2.0, stretch, &points, &edges));
    assert_near(by_stiffness, value / 2.0);
    let moved = |y: f64| functions::springs(2.0, DVec3::new(1.1, y, 1.2), &points, &edges);
    assert_near(by_stretch.y, difference(moved, 0.8));

    let table = [0.0, 1.0, 4.0, 9.0, 16.0];
    for (x, slope) in [(0.5, 1.0), (1.5, 3.0), (3.9, 7.0), (7.0, 7.0)] {
        assert_eq!(functions::interpolated_gradient(x, &table), (functions::interpolated(x, &table), (slope,)));
    }

    let (samples, centres) = ([0.2, -1.4, 2.2, 0.9, 5.0], [0.0, 1.0, 2.0, -1.0]);
    for scale in [0.8, 1.3, -0.4] {
        let (value, (slope,)) = functions::clustered_gradient(scale, &samples, &centres);
        assert_near(value, functions::clustered(scale, &samples, &centres));
        assert_near(slope, difference(|scale| functions::clustered(scale, &samples, &centres), scale));
    }

    let values: Vec<f64> = (0..20).map(|k| f64::from(k * k % 7)).collect();
    let (value, (slope,)) = functions::grid_gradient(0.3, &values, 5);
    assert_near(value, functions::grid(0.3, &values, 5));
    assert_near(slope, difference(|angle| functions::grid(angle, &values, 5), 0.3));
}

#[test]
fn sums_of_sums() {
    let part = |weight, mean, is_used| Part { weight, mean, is_used };
    let parts = [part(0.5, 0.0, true), part(9.0, 0.5, false), part(0.25, 1.5, true)];
    let samples = [0.1, -0.4, 1.2, 2.0];
    for (samples, parts) in [(&samples[..], &parts[..]), (&samples[..2], &parts[..0]), (&samples[..0], &parts[..])] {
        let (value, (by_shift, by_width)) = functions::mixture_gradient(0.2, 0.7, samples, parts);
        assert_near(value, functions::mixture(0.2, 0.7, samples, parts));
        assert_near(by_shift, difference(|shift| functions::mixture(shift, 0.7, samples, parts), 0.2));
        assert_near(by_width, difference(|width| functions::mixture(0.2, width, samples, parts), 0.7));
    }
}

#[test]
fn as_long_as_it_takes_inside() {
    let (times, seen) = ([0.1, 1.0, 2.5, -0.7], [1.0, 0.2, -1.5, 0.6]);
    let (value, (by_a, by_e)) = functions::orbits_gradient(1.2, 0.3, &times, &seen);
    assert_near(value, functions::orbits(1.2, 0.3, &times, &seen));
    assert_near(by_a, difference(|a| functions::orbits(a, 0.3, &times, &seen), 1.2));
    // The derivative of the iterations lacks a small remainder, hence the tolerance.
    assert!((by_e - difference(|e| functions::orbits(1.2, e, &times, &seen), 0.3)).abs() < 1e-4);
    for depth in [0, 1, 4] {
        let weights = [0.5, -0.25, 0.75, 0.3, -0.6];
        for weights in [&weights[..], &weights[..1], &[]] {
            let (values, (by_gain, by_bias)) = functions::layers_jacobian(0.8, 0.4, weights, depth);
            for k in 0..2 {
                assert_near(values[k], functions::layers(0.8, 0.4, weights, depth)[k]);
                assert_near(by_gain[k], difference(|g| functions::layers(g, 0.4, weights, depth)[k], 0.8));
                assert_near(by_bias[k], difference(|b| functions::layers(0.8, b, weights, depth)[k], 0.4));
            }
        }
    }
}

#[test]
fn ways_along_a_slice() {
    let numbers = [0.5, 0.25, -1.0, 2.0, -0.75, 0.125];
    for n in 0..=numbers.len() {
        for (a, size) in [(-1.4, 1), (0.35, 2), (0.8, 4), (2.3, 9), (4.2, 3)] {
            let (value, (slope,)) = functions::blocks_gradient(a, &numbers[..n], size);
            assert_near(value, functions::blocks(a, &numbers[..n], size));
            assert_near(slope, difference(|a| functions::blocks(a, &numbers[..n], size), a));
        }
        for a in [-1.5, -0.1, 0.35, 0.8, 2.3, 4.2] {
            let (value, (slope,)) = functions::sought_gradient(a, &numbers[..n]);
            assert_near(value, functions::sought(a, &numbers[..n]));
            assert_near(slope, difference(|a| functions::sought(a, &numbers[..n]), a));
        }
    }
    let numbers = [0.5, -1.0, 0.25, 2.0, -0.75, 0.125, 1.0];
    for n in 1..=numbers.len() {
        let numbers = &numbers[..n];
        let (value, (by_x, by_k)) = functions::ways_gradient(0.7, 0.3, numbers);
        assert_near(value, functions::ways(0.7, 0.3, numbers));
        assert_near(by_x, difference(|x| functions::ways(x, 0.3, numbers), 0.7));
        assert_near(by_k, difference(|k| functions::ways(0.7, k, numbers), 0.3));
    }
}

#[test]
fn left_from_the_inside() {
    let (rows, columns) = ([1.0, -0.5, 1.5, 0.25], [0.5, 1.0, -2.0, 1.25]);
    for a in [0.1, 0.55, 0.9, 1.35, 2.15, 4.1] {
        let (value, (slope,)) = functions::searched_gradient(a, &rows, &columns);
        assert_near(value, functions::searched(a, &rows, &columns));
        assert_near(slope, difference(|a| functions::searched(a, &rows, &columns), a));
        let (value, (slope,)) = functions::left_gradient(a, &rows, &columns);
        assert_near(value, functions::left(a, &rows, &columns));
        assert_near(slope, difference(|a| functions::left(a, &rows, &columns), a));
    }
}

//! Tests of a module's items: functions, structs, enums, traits, operators.

use super::same;

same! {
    iterators_of_the_module {
        #[derive(Clone, Copy)]
        pub struct Nodes { i: usize, h: f64 }
        impl Iterator for Nodes {
            type Item = f64;
            fn next(&mut self) -> Option<f64> {
                if self.i == 4 { return None; }
                self.i += 1;
                Some(self.h * self.i as f64)
            }
        }
        pub struct Halves { x: f64, n: usize }
        impl Iterator for Halves {
            type Item = f64;
            fn next(&mut self) -> Option<f64> {
                self.x *= 0.5;
                self.n += 1;
                (self.n <= 6 && self.x.abs() > 0.1).then_some(self.x)
            }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let nodes = Nodes { i: 0, h: x };
            let mut sum = nodes.map(|t| t * t).sum::<f64>();
            for t in nodes { if t > 3.0 { break; } sum += t * y; }
            for (k, t) in nodes.zip(Halves { x: y, n: 1 }).enumerate() { sum += t.0 * t.1 * k as f64; }
            sum + Halves { x, n: 0 }.fold(y, |a, b| 0.5 * a + b) + [x, y].into_iter().chain(nodes).skip(1).product::<f64>()
        }
    }
    conversions_by_the_operator {
        #[derive(Clone, Copy)]
        pub struct Radians(pub f64);
        #[derive(Clone, Copy)]
        pub struct Degrees(pub f64);
        impl From<Degrees> for Radians {
            fn from(d: Degrees) -> Self { Radians(d.0.to_radians()) }
        }
        impl std::ops::Sub for Radians {
            type Output = Radians;
            fn sub(self, other: Self) -> Self { Radians(self.0 - other.0) }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let d = Radians(x) - Degrees(y).into() - Degrees(x * y).into();
            d.0 * d.0
        }
    }
    generic_parameters_by_the_expected_result {
        #[derive(Clone, Copy)]
        pub struct Grid<const R: usize>([f64; R]);
        fn pool<const N: usize, const M: usize>(x: &[f64; N]) -> [f64; M] {
            let mut out = [0.0; M];
            for i in 0..M { out[i] = x[2 * i].max(x[2 * i + 1]); }
            out
        }
        fn grid<const R: usize>(x: f64) -> (Grid<R>, f64) {
            let mut out = [x; R];
            for i in 0..R { out[i] += i as f64; }
            (Grid(out), R as f64)
        }
        fn first_two(x: [f64; 4]) -> [f64; 2] { pool(&x) }
        pub fn f(x: f64, y: f64) -> f64 {
            let y2: [f64; 2] = pool(&[x, y, x * y, 1.0]);
            let (Grid(g), n): (Grid<3>, f64) = grid(x);
            let [one] = pool::<2, 1>(&[x, y]);
            y2[0] * y2[1] + g.iter().sum::<f64>() * n + first_two([y, 2.0, x, x])[1] + one
        }
    }
    assignments_through_index_mut {
        use std::ops::{Index, IndexMut};
        #[derive(Clone, Copy)]
        pub struct Table<const R: usize, const C: usize>([[f64; C]; R]);
        impl<const R: usize, const C: usize> Index<(usize, usize)> for Table<R, C> {
            type Output = f64;
            fn index(&self, (r, c): (usize, usize)) -> &f64 { &self.0[r][c] }
        }
        impl<const R: usize, const C: usize> IndexMut<(usize, usize)> for Table<R, C> {
            fn index_mut(&mut self, (r, c): (usize, usize)) -> &mut f64 { &mut self.0[r][c] }
        }
        impl<const R: usize, const C: usize> Index<usize> for Table<R, C> {
            type Output = [f64; C];
            fn index(&self, r: usize) -> &[f64; C] { &self.0[r] }
        }
        impl<const R: usize, const C: usize> IndexMut<usize> for Table<R, C> {
            fn index_mut(&mut self, r: usize) -> &mut [f64; C] { &mut self.0[r] }
        }
        fn set(t: &mut Table<2, 3>, x: f64) {
            t[(0, 2)] = x;
            t[(0, 2)] *= 3.0;
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut t = Table([[y; 3]; 2]);
            t[(0, 1)] = x;
            for c in 0..3 { t[(1, c)] += t[(0, c)] * x; }
            t[1][2] -= y;
            if x > 0.5 { t[(1, 0)] = 2.0; }
            set(&mut t, x + y);
            t.0.iter().flatten().enumerate().map(|(i, v)| v * (i + 1) as f64).sum()
        }
    }
    trait_functions_of_type_parameters {
        trait Real: Copy { fn sign(self) -> f64; fn signum(self) -> f64; fn of(x: f64) -> Self; fn size(t: &Self) -> f64; }
        impl Real for f64 {
            fn sign(self) -> f64 { if self == 0.0 { 0.0 } else { f64::signum(self) } }
            fn signum(self) -> f64 { if self == 0.0 { 0.0 } else { 3.0 } }
            fn of(x: f64) -> f64 { x + 0.5 }
            fn size(t: &f64) -> f64 { t.abs() }
        }
        #[derive(Clone, Copy)]
        struct P(f64);
        impl P { fn size(t: &P) -> f64 { 100.0 * t.0 } }
        impl Real for P {
            fn sign(self) -> f64 { self.0 }
            fn signum(self) -> f64 { 2.0 * self.0 }
            fn of(x: f64) -> P { P(x) }
            fn size(t: &P) -> f64 { t.0 }
        }
        fn g<T: Real>(t: T, x: f64) -> f64 { T::size(&t) + T::signum(T::of(x)) + T::sign(t) }
        pub fn f(x: f64, y: f64) -> f64 { g(x, y) + 10.0 * g(P(y), x) + P::size(&P(x)) + f64::signum(x) }
    }
    helpers_structs_and_constants {
        const WEIGHTS: [f64; 3] = [1.0, SECOND, -0.5];
        const SECOND: f64 = 2.0 * 0.75;
        type Real = f64;
        #[derive(Clone, Copy)]
        struct Spring { rest: Real, stiffness: Real }
        struct Pair(Spring, f64);
        impl Spring {
            const SOFT: Self = Self { rest: 0.5, stiffness: 0.25 };
            fn new(rest: f64) -> Self { Self { rest, ..Self::SOFT } }
            fn energy(&self, x: f64) -> f64 {
                let d = x - self.rest;
                if d < 0.0 { return 0.0; }
                0.5 * self.stiffness * d * d
            }
        }
        fn clamp(x: f64, (low, high): (f64, f64)) -> f64 {
            if x < low { return low; }
            if x > high { high } else { x }
        }
        fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
            let mut sum = 0.0;
            for i in 0..N { sum += a[i] * b[i]; }
            sum
        }
        pub fn f(x: f64, y: f64) -> f64 {
            fn twice(x: f64) -> f64 { 2.0 * x }
            let mut spring = Spring::new(y);
            spring.stiffness += 1.0;
            let Pair(of, w) = Pair(spring, 3.0);
            let scale = SECOND as Real - 1u8 as Real;
            let half = |v: f64| v * scale;
            dot(&WEIGHTS, &[x, y, half(x)]) + of.energy(x) * w + clamp(twice(y), (-1.0, 1.0)) + Spring::SOFT.energy(x)
        }
    }
    changes_through_references {
        #[derive(Clone, Copy)]
        struct State { at: [f64; 2], steps: usize }
        impl State {
            fn step(&mut self, force: f64) -> f64 {
                self.steps += 1;
                if force < -2.0 {
                    self.at[0] = 0.0;
                    return 1.0;
                }
                add(&mut self.at[1], force);
                if self.at[1] > 3.0 { self.at[0] -= 1.0; return 2.0; }
                self.at[0] += 0.1 * self.at[1];
                self.halve();
                0.0
            }
            fn halve(&mut self) { for v in &mut self.at { *v *= 0.5; } }
        }
        fn add(sum: &mut f64, x: f64) { *sum += x; }
        fn both(one: &mut f64, other: &mut f64) { add(one, *other); *other = -*one; }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut state = State { at: [x, 0.5], steps: 0 };
            let mut sum = 0.0;
            for force in [y, x, 1.0] { sum += state.step(force); }
            let mut table = [x, y, 3.0, 4.0];
            for (i, v) in table.iter_mut().enumerate() {
                if *v < 0.5 { continue; }
                *v += i as f64;
                if *v > 4.0 { break; }
                *v *= 2.0;
            }
            table.swap(1, 3);
            let (mut a, mut b) = (x, y);
            if x > y { both(&mut a, &mut b); }
            let alias = &mut sum;
            *alias += 0.25;
            sum + state.at[0] - 2.0 * state.at[1] + state.steps as f64
                + table[0] - 3.0 * table[1] + 7.0 * table[2] + table[3] + 11.0 * a + 13.0 * b
        }
    }
    operators_of_structs {
        use core::ops::{Add, AddAssign, Mul, Neg};
        #[derive(Clone, Copy)]
        struct Pair { a: f64, b: f64 }
        impl Default for Pair { fn default() -> Self { Self { a: 1.0, b: 2.0 } } }
        impl Add for Pair { type Output = Self; fn add(self, o: Self) -> Self { Self { a: self.a + o.a, b: self.b + o.b } } }
        impl Mul<f64> for Pair { type Output = Self; fn mul(self, k: f64) -> Self { Self { a: self.a * k, b: self.b * k } } }
        impl Neg for Pair { type Output = Self; fn neg(self) -> Self { self * -1.0 } }
        impl AddAssign for Pair { fn add_assign(&mut self, o: Self) { *self = *self + o; } }
        fn slope(s: Pair) -> Pair { Pair { a: s.b, b: -s.a.sin() } }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut s = Pair { a: x, b: y } + Pair::default();
            for i in 0..2usize.pow(2) {
                let k1 = slope(s);
                let k2 = slope(s + k1 * 0.05);
                s += k2 * (0.1 * i as f64);
                if s.a > 3.0 { s = -s; }
            }
            s.a - 3.0 * s.b
        }
    }
    nested_modules {
        use shapes::round::{self, ball as sphere};
        static WEIGHTS: [f64; 2] = [2.0, shapes::K];
        const K: f64 = 5.0;
        mod consts {
            pub const PI: f64 = 3.0;
            pub const E: f64 = super::K - 2.5;
        }
        mod shapes {
            use super::K as OUTER;
            pub const K: f64 = 0.5;
            #[derive(Clone, Copy, Default)]
            pub struct Box { pub half: f64, pub at: Place }
            #[derive(Clone, Copy)]
            pub struct Place(pub f64);
            impl Default for Place { fn default() -> Self { Self(K) } }
            impl Box {
                pub const UNIT: Self = Self { half: 1.0, at: Place(OUTER) };
                pub fn size(self, x: f64) -> f64 { (x - self.at.0).abs() - self.half * K }
            }
            pub mod round {
                use super::*;
                pub type Cube = Box;
                pub fn ball(x: f64, r: f64) -> f64 { x.abs() - r * K + twice(self::depth(x)) }
                fn depth(x: f64) -> f64 { x * super::super::K }
            }
            fn twice(x: f64) -> f64 { 2.0 * x }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            use shapes::*;
            use std::f64::consts::*;
            let cube = round::Cube { half: x, ..Default::default() };
            let inner = { use self::shapes::round::ball; static N: f64 = 4.0; ball(x, N) };
            let UNIT = shapes::Box::UNIT;
            let place = { use shapes::Place as At; fn of(at: At) -> f64 { at.0 } let at: At = Default::default(); of(at) + (|k: f64| At(k).0)(x) };
            const ONE: usize = 1;
            let picked: f64 = (0..3).map(|i| match i { ONE => place, _ => 0.0 }).sum();
            picked + cube.size(y) + UNIT.size(x) + sphere(x, y) + round::ball(y, 1.0) + inner + WEIGHTS.iter().sum::<f64>()
                + consts::PI * y + consts::E + TAU * x + K
        }
    }
    functions_with_the_same_name {
        use std::ops::{Add, Mul, Neg, Sub};
        #[derive(Clone, Copy)]
        struct V(f64, f64);
        impl Mul<V> for f64 { type Output = V; fn mul(self, v: V) -> V { V(self * v.0, self * v.1) } }
        impl Mul<f64> for V { type Output = V; fn mul(self, k: f64) -> V { V(k * self.0, k * self.1 + 1.0) } }
        impl Mul for V { type Output = f64; fn mul(self, o: V) -> f64 { self.0 * o.0 - self.1 * o.1 } }
        impl Add for V { type Output = V; fn add(self, o: V) -> V { V(self.0 + o.0, self.1 + o.1) } }
        impl Sub<[f64; 2]> for V { type Output = V; fn sub(self, o: [f64; 2]) -> V { V(self.0 - o[0], self.1 - o[1]) } }
        impl Add<&V> for V { type Output = V; fn add(self, o: &V) -> V { self + *o } }
        impl<'a> Sub<&'a V> for &'a V { type Output = V; fn sub(self, o: &V) -> V { V(self.0 - o.0, self.1 - 2.0 * o.1) } }
        impl std::ops::Div for &V { type Output = f64; fn div(self, o: &V) -> f64 { self.0 / (3.0 + o.1 * o.1) } }
        fn made<V: Copy>(v: V) -> V { v }
        impl Neg for V { type Output = V; fn neg(self) -> V { V(-self.0, self.1) } }
        impl From<f64> for V { fn from(x: f64) -> V { V(x, 1.0) } }
        impl From<[f64; 2]> for V { fn from([x, y]: [f64; 2]) -> V { V(x, y) } }
        impl From<(f64, usize)> for V { fn from((x, n): (f64, usize)) -> V { V(x, n as f64) } }
        pub fn f(x: f64, y: f64) -> f64 {
            let v = 2.0 * V::from([x, y]) + V::from(y) * x + V::from((x, 3)) - [y, 0.5];
            v * -v + (x * v).1 + (v + &made(v)).0 + (&v - &v).1 + &v / &made(v)
        }
    }
    options_in_helpers {
        #[derive(Clone, Copy)]
        struct Hit { at: f64, side: f64 }
        fn hit(x: f64, y: f64) -> Option<Hit> {
            if x < y { return None; }
            let root = root(x - y)?;
            if root > 1.0 { Some(Hit { at: root, side: -1.0 }) } else { Some(Hit { at: x, side: 1.0 }) }
        }
        fn root(x: f64) -> Option<f64> { if x > 0.25 { Some(x.sqrt()) } else { None } }
        fn limited(x: f64, limit: Option<f64>) -> f64 {
            let Some(limit) = limit else { return x };
            x.min(limit)
        }
        fn shadowed(x: f64) -> f64 {
            let Some(x) = root(x + 1.0) else { return 2.0 * x };
            x
        }
        fn nearest(x: f64) -> Option<f64> {
            let mut best: Option<f64> = None;
            for c in [1.0, -2.0, 0.25] {
                let d = (x - c).abs();
                if d > 2.5 { continue; }
                if best.is_none() || d < best.unwrap_or(0.0) { best = Some(d); }
            }
            best
        }
        pub fn f(x: f64, y: f64) -> f64 {
            assert!(x < 100.0, "too far");
            assert_eq!(1, 1);
            let &[a, b] = &[x, y] else { unreachable!() };
            let seen = if let Some(Hit { at, side }) = hit(a, b) && at > 0.6 { at * side } else { -7.0 };
            let other = match root(y) { Some(r) if r > 1.0 => r, Some(_) => 1.0, None => x };
            let n = if x > 1000.0 { panic!("never") } else { 2.0 };
            let mapped = root(x).map(|r| r + 1.0).and_then(|r| if r < 2.0 { Some(r) } else { None }).map_or(0.5, |r| 3.0 * r);
            seen + other * n + 7.0 * shadowed(x) + nearest(x).unwrap_or(9.0) + limited(x, Some(y)) + limited(y, None) + mapped + root(y).unwrap_or_else(|| x)
                + if root(x).is_some() { 1.0 } else { 0.0 }
        }
    }
    traits_of_numbers {
        trait More {
            fn over(self, o: Self) -> Self;
            fn sqrt(self) -> Self;
            fn double(&mut self);
        }
        impl More for f64 {
            fn over(self, o: f64) -> f64 { (self - o).max(0.0) }
            fn sqrt(self) -> f64 { 1000.0 }
            fn double(&mut self) { *self *= 2.0; }
        }
        struct Meters(f64);
        impl From<Meters> for f64 { fn from(m: Meters) -> f64 { 3.0 * m.0 } }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut z = x.over(y) + f64::over(y, x);
            z.double();
            z + (x * x).sqrt() + <f64 as More>::sqrt(x) + f64::sqrt(y * y) + f64::from(Meters(x)) + f64::from(3u8)
        }
    }
    enums {
        #[derive(Clone, Copy, PartialEq, Default)]
        pub enum Side { Left, #[default] Right }
        #[derive(Clone, Copy)]
        pub enum Easing { Linear, Power(i32), Elastic { period: f64, side: Side }, Steps(f64, f64, f64), Square(f64) }
        impl Easing {
            const DEFAULT: Self = Self::Power(2);
            fn eval(self, t: f64) -> f64 {
                use Easing::*;
                match self {
                    Linear => t,
                    Power(2) => t * t,
                    Power(n) if n > 5 => 1.0,
                    Power(_) => t * t * t,
                    Elastic { period, side: Side::Left } => (t / period).sin(),
                    Self::Elastic { period, .. } => -(t / period).sin(),
                    Steps(first, .., last) if t > 0.0 => first * t + last,
                    Square(k) | Steps(_, k, _) => k * t,
                }
            }
            fn scale(&mut self, k: f64) {
                if let Easing::Elastic { period, side } = *self { *self = Easing::Elastic { period: k * period, side }; }
            }
        }
        fn chosen(x: f64) -> Easing {
            if x < -1.0 { return Easing::Linear; }
            if x < 0.0 { Easing::Elastic { period: 2.0 + x, side: if x < -0.5 { Side::Left } else { Side::default() } } }
            else if x < 1.0 { Easing::Steps(x, 2.0, 3.0) } else if x < 3.0 { Easing::Square(x) } else { Easing::DEFAULT }
        }
        enum Only { One(f64, f64) }
        pub fn f(x: f64, y: f64) -> f64 {
            let Only::One(a, b) = Only::One(x, y);
            let (x, y) = [Only::One(a, b)].into_iter().map(|Only::One(a, b)| (a, b)).next().unwrap();
            let mut one = chosen(x);
            let other = chosen(y);
            one.scale(1.5);
            let side = if x > y { Side::Left } else { Side::Right };
            let is_square = matches!(other, Easing::Square(k) | Easing::Steps(k, ..) if k > 0.5);
            let Easing::Power(n) = Easing::Power(3) else { return 0.0 };
            one.eval(y) + 2.0 * other.eval(x) + if side == Side::Left { 10.0 } else { 0.0 } + if is_square { 20.0 } else { 0.0 }
                + n as f64 + [Easing::Linear, one].iter().map(|e| e.eval(0.5)).sum::<f64>()
        }
    }
    equality_and_results {
        #[derive(Clone, Copy, PartialEq)]
        enum Joint { Fixed, Hinge(f64, i32), Slide { along: f64 } }
        #[derive(Clone, Copy)]
        enum Parity { Even, Odd }
        impl PartialEq for Parity { fn eq(&self, _: &Self) -> bool { matches!(self, Parity::Odd) } }
        #[derive(PartialEq)]
        struct Pose { at: [f64; 2], joint: Joint }
        fn joint(x: f64) -> Joint {
            if x < 0.0 { Joint::Fixed } else if x < 1.5 { Joint::Hinge(x.floor(), 2) } else { Joint::Slide { along: 1.0 } }
        }
        fn root(x: f64) -> Result<f64, &'static str> { if x < 0.0 { Err("negative") } else { Ok(x.sqrt()) } }
        fn both(x: f64, y: f64) -> Result<f64, &'static str> { Ok(root(x)? + root(y)?) }
        pub fn f(x: f64, y: f64) -> f64 {
            let number = |truth: bool| if truth { 1.0 } else { 0.0 };
            let (a, b) = (Pose { at: [x, 1.0], joint: joint(x) }, Pose { at: [x.max(0.5), 1.0], joint: joint(y) });
            if x + y > 100.0 { return f64::NAN; }
            let pair = [2.0, -1.0, 0.5];
            let index = (x + 3.0) as usize;
            let quotient = x / (y - 0.75);
            number(joint(x) == joint(y)) + 2.0 * number(joint(x) != Joint::Fixed) + 4.0 * number(a == b)
                + 8.0 * number(Parity::Even == Parity::Even) + 16.0 * number(Parity::Odd == Parity::Even)
                + 32.0 * number(Some(x.floor()) == if y > 0.0 { Some(0.0) } else { None })
                + match both(x, y) { Ok(v) => v, Err(_) => -3.0 } + root(y).unwrap_or(0.5) + number(root(x).is_ok())
                + pair.get(index).copied().unwrap_or(7.0) + if quotient.is_finite() { quotient } else { 11.0 }
                + number(quotient.is_nan()) + (x * 1e10) as i32 as f64
        }
    }
    trait_defaults_and_conversions {
        trait Shape {
            const SIDES: f64 = 4.0;
            fn area(&self) -> f64;
            fn scaled(&self, k: f64) -> f64 { k * k * self.area() + Self::SIDES }
            fn unit() -> f64 { 2.0 * Self::SIDES }
        }
        #[derive(Clone, Copy)]
        struct Circle(f64);
        struct Square { side: f64 }
        impl Shape for Circle {
            const SIDES: f64 = 0.5;
            fn area(&self) -> f64 { 3.0 * self.0 * self.0 }
        }
        impl Shape for Square {
            fn area(&self) -> f64 { self.side * self.side }
            fn scaled(&self, k: f64) -> f64 { k - self.area() }
        }
        struct Polar { length: f64, angle: f64 }
        impl From<[f64; 2]> for Polar {
            fn from([x, y]: [f64; 2]) -> Self { Self { length: x.hypot(y), angle: y.atan2(x + 10.0) } }
        }
        impl From<Circle> for Polar { fn from(of: Circle) -> Self { Self { length: of.0, angle: 0.0 } } }
        fn sum(p: Polar) -> f64 { p.length + p.angle }
        pub fn f(x: f64, y: f64) -> f64 {
            let polar: Polar = [x, y].into();
            Circle(x).scaled(y) + Square { side: y }.scaled(x) + Circle::unit() + Square::unit() + sum(polar) + sum(Circle(y).into())
        }
    }
    default_values_in_every_position {
        #[derive(Clone, Copy)]
        struct P { a: f64, b: f64 }
        impl Default for P { fn default() -> P { P { a: 2.0, b: 3.0 } } }
        #[derive(Clone, Copy, Default)]
        struct Q { p: P, n: usize, w: [P; 2], pair: (f64, P), on: bool }
        struct T(P, f64);
        type Alias = P;
        struct Named;
        impl Named { fn default() -> f64 { 7.0 } }
        #[derive(Default)]
        struct Both { c: f64 }
        impl Both { fn default() -> f64 { 11.0 } }
        fn sum(p: P, q: &[P; 2]) -> f64 { p.a * p.b + q[1].b }
        fn made() -> P { Default::default() }
        fn early(x: f64) -> P { if x > 0.0 { return Default::default(); } P { a: x, ..Default::default() } }
        fn last() -> Q { let closure = || -> Q { Default::default() }; closure() }
        pub fn f(x: f64, y: f64) -> f64 {
            let p = P { a: x, ..Default::default() };
            let q = Q { n: 2, ..Default::default() };
            let t = T(Default::default(), y);
            let typed: P = Default::default();
            let (one, [two, _]): (Alias, [P; 2]) = (Default::default(), [Default::default(), P { a: y, ..P::default() }]);
            let mut changed = P { a: x, b: y };
            if x > y { changed = Default::default(); }
            let chosen: P = if x > 1.0 { Default::default() } else { p };
            let matched: P = match q.n { 2 => Default::default(), _ => p };
            let number: f64 = Default::default();
            p.a * p.b + q.p.b * q.n as f64 + t.0.a * t.1 + typed.b + one.a * two.b + changed.b + chosen.a + matched.b
                + sum(Default::default(), &[p, Default::default()]) + made().b + early(y).b + last().pair.1.a + q.w[1].a
                + number + <P as Default>::default().a + Named::default() + Both::default() + if q.on { 1.0 } else { 0.0 }
                + { let both: Both = Default::default(); both.c }
        }
    }
    closures_that_change_captured_variables {
        pub fn f(x: f64, y: f64) -> f64 {
            let (mut total, mut count, mut path) = (0.0, 0, [x, y]);
            let mut add = |v: f64, weight: f64| {
                if v < -1.0 { return; }
                total += weight * v;
                count += 1;
                path[1] *= if count % 2 == 0 { 0.5 } else { -1.0 };
            };
            add(x, 1.0);
            add(y, 2.0);
            for k in 0..3 { if k != 1 { add(k as f64, 0.5); } }
            let mut last = x;
            let mut step = || { last = 0.5 * last + y; last };
            let first = step();
            let second = if y > 0.0 { step() } else { 7.0 };
            let k = 3.0;
            let scaled = move |v: f64| v * k;
            let mut seen = 0.0;
            let doubled: Vec<f64> = [x, y].iter().map(|v| { seen += v; 2.0 * v }).collect();
            total + path[0] - path[1] + first + 3.0 * second + scaled(last) + seen + doubled[1]
        }
    }
    functions_as_values {
        fn midpoint(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 { (b - a) * f(0.5 * (a + b)) }
        fn twice(f: fn(f64) -> f64, x: f64) -> f64 { f(f(x)) }
        fn apply(f: &dyn Fn(f64, f64) -> f64, x: f64, y: f64) -> f64 { f(x, y) }
        pub fn f(x: f64, y: f64) -> f64 {
            let act = f64::tanh;
            midpoint(f64::sin, x, y) + twice(f64::cos, x) + apply(&f64::hypot, x, y) + act(y) + apply(&f64::max, x, y)
        }
    }
    generic_structs {
        use std::ops::{Add, Mul};
        #[derive(Clone, Copy, PartialEq)]
        pub struct Matrix<const R: usize, const C: usize> { data: [[f64; C]; R] }
        impl<const R: usize, const C: usize> Matrix<R, C> {
            const fn new(data: [[f64; C]; R]) -> Self { Self { data } }
            fn zeros() -> Self { Self { data: [[0.0; C]; R] } }
            fn transpose(&self) -> Matrix<C, R> {
                let mut out = Matrix::<C, R>::zeros();
                for r in 0..R { for c in 0..C { out.data[c][r] = self.data[r][c]; } }
                out
            }
            fn size(&self) -> usize { R * 10 + C }
            fn like(&self) -> Self { Self::zeros() }
        }
        impl<const R: usize, const K: usize, const C: usize> Mul<Matrix<K, C>> for Matrix<R, K> {
            type Output = Matrix<R, C>;
            fn mul(self, rhs: Matrix<K, C>) -> Matrix<R, C> {
                let mut out = Matrix::zeros();
                for r in 0..R { for c in 0..C { for k in 0..K { out.data[r][c] += self.data[r][k] * rhs.data[k][c]; } } }
                out
            }
        }
        impl<const R: usize, const C: usize> Add for Matrix<R, C> {
            type Output = Self;
            fn add(mut self, rhs: Self) -> Self {
                for (row, other) in self.data.iter_mut().zip(&rhs.data) { for (a, b) in row.iter_mut().zip(other) { *a += b; } }
                self
            }
        }
        type Rows<T, const N: usize> = [T; N];
        type Pairs<const N: usize> = Rows<[f64; 2], N>;
        const Q: Matrix<2, 3> = Matrix::new([[1.0, 0.5, -1.0], [0.0, 0.1, 2.0]]);
        trait Field: Copy + Add<Output = Self> + Mul<Output = Self> { const ZERO: Self; fn from_f64(value: f64) -> Self; }
        impl Field for f64 { const ZERO: f64 = 0.0; fn from_f64(value: f64) -> f64 { value } }
        #[derive(Clone, Copy)]
        struct Pair { a: f64, b: f64 }
        impl Add for Pair { type Output = Self; fn add(self, o: Self) -> Self { Pair { a: self.a + o.a, b: self.b + o.b } } }
        impl Mul for Pair { type Output = Self; fn mul(self, o: Self) -> Self { Pair { a: self.a * o.a - self.b * o.b, b: self.a * o.b + self.b * o.a } } }
        impl Field for Pair { const ZERO: Pair = Pair { a: 0.0, b: 0.0 }; fn from_f64(value: f64) -> Pair { Pair { a: value, b: 0.0 } } }
        struct Polynomial<T, const N: usize> { coefficients: [T; N] }
        fn horner<T: Field>(coefficients: &[T], x: T) -> T { coefficients.iter().rev().fold(T::ZERO, |sum, &c| sum * x + c) }
        impl<T: Field, const N: usize> Polynomial<T, N> {
            fn at(&self, x: T) -> T { horner(&self.coefficients, x) + T::from_f64(N as f64) }
        }
        struct Nest<'a> { shares: &'a [f64], power: f64 }
        impl Nest<'_> { fn index(&self, prices: impl IntoIterator<Item = f64>) -> f64 { prices.into_iter().zip(self.shares).map(|(p, s)| s * p * self.power).sum() } }
        const FOOD: Nest<'static> = Nest { shares: &[0.5, 0.3], power: 2.0 };
        #[derive(Clone, Copy, Default)]
        struct Queue<T, const N: usize> where T: Copy { items: [T; 2], last: T }
        enum Either<A, B> { One(A), Other(B) }
        fn of<const N: usize, T>(either: Either<T, [f64; N]>, read: impl Fn(T) -> f64) -> f64 {
            match either { Either::One(one) => read(one), Either::Other(all) => all.iter().sum::<f64>() * N as f64 }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let a = { let m = [[x, y], [1.0, x]].into_iter().collect::<Vec<_>>(); let m = Matrix::new([m[0], m[1]]); m };
            let small: f64 = { let made = [x, y].into_iter().collect::<Vec<f64>>(); let made = made.iter().sum(); made };
            let product = a * Q + a.transpose() * Q;
            let one: Matrix<1, 3> = Matrix::zeros();
            let sized = (product.size() + one.size() + product.transpose().like().size()) as f64;
            let rows: Pairs<3> = std::array::from_fn(|i| [x * i as f64, y]);
            let small = small + rows.iter().flatten().sum::<f64>();
            let p = Polynomial { coefficients: [x, 1.0, y] };
            let c = Polynomial { coefficients: [Pair { a: x, b: 1.0 }, Pair { a: y, b: x }] };
            let at = c.at(Pair { a: y, b: 0.5 });
            let empty: Queue<f64, 3> = Queue::default();
            let either = if x > 0.0 { Either::One(y) } else { Either::Other([x, y, 1.0]) };
            small + product.data[0][2] + 2.0 * product.data[1][1] + sized + p.at(y) + at.a * at.b + FOOD.index([x, y]) + empty.last
                + of(either, |v| v * v) + empty.items[1]
        }
    }
    unit_structs_numbers_of_variants_and_own_indices {
        trait Kernel { fn at(&self, r: f64) -> f64; }
        #[derive(Clone, Copy)]
        struct Gauss;
        struct Cubic;
        impl Kernel for Gauss { fn at(&self, r: f64) -> f64 { (-r * r).exp() } }
        impl Kernel for Cubic { fn at(&self, r: f64) -> f64 { r * r * r } }
        fn of(kernel: &dyn Kernel, r: f64) -> f64 { kernel.at(r) + Gauss.at(0.5 * r) }
        #[derive(Clone, Copy, PartialEq)]
        enum Frequency { Annual = 1, SemiAnnual = BASE * 2, Quarterly = 4, Other }
        const BASE: isize = 1;
        struct Spline([f64; 3]);
        impl std::ops::Index<usize> for Spline {
            type Output = f64;
            fn index(&self, i: usize) -> &f64 { match i { 0 => &self.0[0], 1 => &self.0[1], _ => &self.0[2] } }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let frequency = if x < 0.0 { Frequency::Annual } else if x < 1.5 { Frequency::SemiAnnual } else { Frequency::Other };
            let n = frequency as u32 as f64 + Frequency::Quarterly as i32 as f64;
            let s = Spline([x, y, 2.0]);
            let n = n + f64::from(u8::from(x > y)) + usize::from(y > 0.0) as f64;
            of(&Gauss, x) + of(&Cubic, y) + n * x + s[1] * s[if y > 0.0 { 0 } else { 2 }]
        }
    }
    generic_functions {
        fn sum<const N: usize>(v: [f64; N]) -> f64 { if N == 0 { return 0.0; } let mut s = 0.0; for i in 0..N { s += v[i] * (N - i) as f64; } s }
        fn halves<const N: usize>(v: [f64; N], depth: usize) -> f64 { if depth == 0 { sum(v) } else { halves([v[0], v[N - 1]], depth - 1) + N as f64 } }
        struct Poly<const N: usize> { c: [f64; N] }
        impl<const N: usize> Poly<N> {
            const DEGREE: usize = N - 1;
            fn at(&self, x: f64) -> f64 { let n = N as f64; let f = |k: f64| k * n; self.c.iter().rev().fold(0.0, |s, c| s * x + c) + f(0.5) }
            fn map<const M: usize>(&self, of: impl Fn(f64) -> [f64; M]) -> [[f64; M]; N] { std::array::from_fn(|i| of(self.c[i])) }
            fn one() -> Self { Self { c: [1.0; N] } }
            fn plus(&self, other: &Self) -> Self { let mut out = Self::one(); for i in 0..N { out.c[i] += self.c[i] + other.c[i]; } out }
        }
        struct Wrap<T> { inner: T, w: f64 }
        impl<T: Fn(f64) -> f64> Wrap<T> { fn call(&self, x: f64) -> f64 { self.w * (self.inner)(x) } }
        fn default_of<T: Default>(_like: &T) -> T { T::default() }
        pub fn f(x: f64, y: f64) -> f64 {
            let p = Poly { c: [x, y, 1.0] };
            let q = p.plus(&Poly::<3>::one());
            let r: Poly<3> = Poly::one();
            let m = p.map(|c| [c, 2.0 * c]);
            let w = Wrap { inner: |v: f64| v * v, w: y };
            let d = default_of(&x);
            sum([x, y]) + halves([x, y, 1.0, 2.0], 2) + p.at(0.5) + q.at(x) + r.at(y) + m[2][1] + m[0][0] + w.call(x) + d
        }
    }
    explicit_generic_arguments {
        type Row<const N: usize> = [f64; N];
        type Matrix<const N: usize> = [Row<N>; N];
        const MORE: usize = 4;
        fn norm<const N: usize>(a: &Row<N>) -> f64 { (0..N).map(|i| a[i] * a[i]).sum() }
        fn corners<const N: usize>(a: &Matrix<N>) -> f64 { let mut l = [[0.0; N]; N]; l[0][N - 1] = a[0][0]; l[0][N - 1] + a[N - 1][0] }
        fn powers<const N: usize>(x: f64) -> f64 { (0..N).map(|i| x.powi(i as i32)).sum() }
        fn repeated<T: Copy, const K: usize>(x: T) -> f64 { let y = [x; K]; y.len() as f64 }
        pub fn f(x: f64, y: f64) -> f64 {
            let sums = powers::<3>(x) + powers::<MORE>(y) + powers::<{ MORE + 1 }>(x);
            norm(&[x, y, 1.0]) + corners(&[[x, 2.0], [y, x * y]]) + sums + repeated::<f64, 2>(x) + x * repeated::<_, MORE>(y)
        }
    }
    generic_arguments_inferred_from_the_result {
        struct Matrix<const R: usize, const C: usize> { data: [[f64; C]; R] }
        impl<const R: usize, const C: usize> Matrix<R, C> {
            fn flipped_ones() -> Matrix<C, R> { Matrix { data: [[1.0 + R as f64 * 10.0; R]; C] } }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let m: Matrix<3, 2> = Matrix::flipped_ones();
            let n = Matrix::<1, 2>::flipped_ones();
            x * m.data[2][1] + y * n.data[1][0]
        }
    }
    lengths_inferred_from_fields {
        use std::array::from_fn;
        use std::ops::{Add, Sub};
        #[derive(Clone, Copy)]
        struct V<const N: usize>([f64; N]);
        struct Pair<T, const N: usize> { first: [T; N], second: V<N> }
        impl<const N: usize> Add for V<N> { type Output = Self; fn add(self, o: Self) -> Self { V(from_fn(|i| self.0[i] + o.0[i])) } }
        impl<const N: usize> Sub for V<N> { type Output = V<N>; fn sub(self, o: Self) -> V<N> { Self(from_fn(|i| self.0[i] - o.0[i])) } }
        impl<const N: usize> Pair<f64, N> {
            fn reversed(&self) -> Self { Pair { second: V(from_fn(|i| self.first[N - 1 - i])), first: from_fn(|i| self.second.0[i]) } }
        }
        fn ramp<const N: usize>(x: f64) -> V<N> { V(from_fn(|i| i as f64 * x)) }
        pub fn f(x: f64, y: f64) -> f64 {
            let (u, v) = (V([x, y, 1.0]), V::<3>(from_fn(|i| x - i as f64 * y)));
            let w: V<3> = V(from_fn(|i| y + i as f64));
            let pair = Pair { first: [x, x * y, y], second: u + v - w }.reversed();
            pair.first[0] * pair.second.0[0] + pair.first[2] - pair.second.0[1] + ramp::<4>(y).0[3]
        }
    }
    integers_rounded_by_a_cast_to_f32 {
        pub fn f(x: f64, y: f64) -> f64 { (16777217i32 as f32 as f64 - 16777216.0) * x + (-3i32) as f32 as f64 * y }
    }
}

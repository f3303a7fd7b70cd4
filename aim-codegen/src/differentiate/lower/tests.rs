//! That a function is run as the compiler runs it: the same text, compiled and interpreted.

use aim_symbolic::Bindings;
use syn::Item;

use super::{Algebra, Translation, Value};
use crate::declare::report::Report;
use crate::declare::tree::Notation;
use crate::differentiate::items::Items;
use crate::differentiate::types::Precision;

/// The value of the last function of a module at these numbers, by interpretation.
fn interpreted(module: &str, arguments: [f64; 2]) -> f64 {
    let file: syn::File = syn::parse_str(module).expect("it has been compiled");
    let items = Items::of(&file.items);
    let Some(Item::Fn(function)) = file.items.last() else { panic!("a function stands last") };
    let (mut algebra, mut report) = (Algebra::new(), Report::new(Notation::Rust));
    let inputs = ["x", "y"].map(|name| algebra.g.input(name));
    let patterns = function.sig.inputs.iter().map(|input| match input {
        syn::FnArg::Typed(typed) => &*typed.pat,
        syn::FnArg::Receiver(_) => panic!("of functions"),
    });
    let values = inputs.map(Value::Scalar);
    let value = Translation::new(&mut algebra, &mut report, &items, Some(Precision::Double)).function(
        &function.block,
        &function.sig.output,
        patterns.zip(values),
        &[],
    );
    let errors: Vec<String> = report.into_list().into_iter().map(|error| error.message().to_owned()).collect();
    assert!(errors.is_empty(), "{errors:?} in {module}");
    let Value::Scalar(value) = value else { panic!("a number comes of it: {value:?} in {module}") };
    let bindings = Bindings::new(&algebra.g, &arguments, &[]);
    algebra.g.evaluate(value, &bindings)
}

/// Compiles a module whose last function is `f`, and compares it with its own text at points on both sides of all its
/// branches.
macro_rules! same {
    ($($name:ident { $($module:item)* })*) => {$(
        #[test]
        fn $name() {
            #[allow(clippy::all, clippy::pedantic, warnings, reason = "as users write it")]
            mod compiled {
                $($module)*
            }
            let text = concat!($(stringify!($module), "\n"),*);
            for x in [-2.5, -1.0, -0.25, 0.5, 1.0, 2.0, 3.75] {
                for y in [-3.0, -0.5, 0.0, 0.75, 2.5] {
                    let (found, expected) = (interpreted(text, [x, y]), compiled::f(x, y));
                    let close = (found - expected).abs() <= 1e-12 * (1.0 + expected.abs());
                    assert!(close || found == expected, "f({x}, {y}): {found}, compiled {expected}");
                }
            }
        }
    )*};
}

same! {
    assignments_in_branches {
        pub fn f(mut x: f64, y: f64) -> f64 {
            let (mut a, mut b) = (1.0, y);
            if x > 0.0 {
                a = x;
                if y > x { let mut c = a; c *= y; b += c; } else { (a, b) = (b, a); }
                x *= 2.0;
            } else if y < -1.0 {
                b -= 3.0;
            }
            let late;
            if b > 1.0 { late = b; } else { late = -a; }
            x + 10.0 * a + 100.0 * b + 1000.0 * late
        }
    }
    early_returns {
        pub fn f(x: f64, y: f64) -> f64 {
            if x < -2.0 { return y; }
            let mut sum = x;
            if y > 0.5 {
                sum += 1.0;
                if x > 1.5 { return sum * y; }
                sum *= 3.0;
            } else if x > 3.0 {
                return if y < 0.0 { -1.0 } else { return 7.0 };
            }
            let kept = if sum > 2.0 { sum } else if y == 0.0 { return 5.0 } else { 2.0 };
            if kept > 4.0 { kept } else { kept - x }
        }
    }
    loops_with_ways_out {
        pub fn f(x: f64, y: f64) -> f64 {
            let table = [0.5, -1.0, 2.0, 4.0];
            let mut sum = 0.0;
            for (i, t) in table.iter().enumerate() {
                if *t < y { continue; }
                sum += t * x;
                if sum > 3.0 && i > 0 { break; }
                if sum < -6.0 { return sum; }
                sum += 0.125 * i as f64;
            }
            let mut rounds = 0;
            'outer: for i in 0..3 {
                for j in (i..3).rev() {
                    rounds += 1;
                    if x > table[i] + table[j] { continue 'outer; }
                    if y > table[j] { break 'outer; }
                    sum += 0.01 * (i * j) as f64;
                }
                sum -= 0.001;
            }
            sum + rounds as f64
        }
    }
    assigned_on_the_way_out {
        pub fn f(x: f64, y: f64) -> f64 {
            let (mut a, mut b, mut c) = (x, 0.0, 1.0);
            for i in 0..3 {
                if a > 1.0 {
                    b = a;
                    break;
                }
                if y < i as f64 {
                    a -= 2.0 * y;
                    continue;
                }
                b += 0.25;
            }
            'once: loop {
                for _ in 0..2 {
                    if x > y { c = x * b; break 'once; }
                    c += y;
                }
                if a < b { a = c; break; } else { c *= 3.0; break; }
            }
            a + 10.0 * b + 100.0 * c
        }
    }
    counting_loops {
        pub fn f(x: f64, y: f64) -> f64 {
            let mut n = 0;
            let mut power = 1.0;
            while n < 4 {
                n += 1;
                if n == 2 { continue; }
                power *= x;
                for _ in 0..n { power += y; }
            }
            for _ in 3..3 { power = 0.0; }
            power += (n % 3) as f64;
            loop {
                power -= x;
                n -= 1;
                if power > 50.0 { break; }
                if n < 2 { break; }
            }
            power + n as f64
        }
    }
    newton_until_it_is_close {
        pub fn f(x: f64, y: f64) -> f64 {
            let mut guess = x.abs() + 1.0;
            for _ in 0..20 {
                let next = 0.5 * (guess + (y * y + 2.0) / guess);
                if (next - guess).abs() < 1e-9 { return next; }
                guess = next;
            }
            guess
        }
    }
    defaults_and_arrays_at_the_end {
        #[derive(Clone, Copy, Default)]
        struct Lens { focal: f64, shift: f64, bent: [f64; 2] }
        fn rates([a, b]: [f64; 2], lens: &Lens) -> [f64; 2] {
            core::array::from_fn(|i| [a * b, b][i] + lens.bent[i] + lens.shift)
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let lens = Lens { focal: x, ..Default::default() };
            let other = Lens { bent: [y, 2.0], ..Lens::default() };
            let [a, b] = rates([x, lens.focal + y], &other);
            a - b * lens.bent[1] + f64::default() + lens.focal
        }
    }
    arrays_of_arrays {
        pub fn f(x: f64, y: f64) -> f64 {
            const N: usize = 3;
            use core::f64::consts::{FRAC_PI_3 as THIRD, TAU};
            let squares: [f64; N] = core::array::from_fn(|i| x * (i * i) as f64);
            let mut m = [[0.0; N]; N];
            for i in 0..N {
                for j in 0..N {
                    m[i][j] = if i == j { x } else { y * (i + 2 * j) as f64 };
                    if i > 0 { m[i][j] -= 0.5 * m[i - 1][j]; }
                }
            }
            let [first, .., last] = [m[0], m[1], m[2]];
            let [_, rest @ ..] = m;
            let mut trace = 0.0;
            for (row, w) in m.iter().zip([1.0, -2.0, 0.5]) {
                for v in row { trace += w * v * v; }
            }
            let windows: f64 = m[1].windows(2).map(|w| w[1] - w[0]).sum();
            trace + rest[1][0] + squares[2] * THIRD / TAU + first[1] + last[2] + windows + m[1..].iter().map(|row| row[0]).fold(0.0, f64::max)
        }
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
            let scale = 0.5;
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
    matches {
        fn mode(k: usize, x: f64) -> f64 {
            match k {
                0 => x,
                1 | 2 if x > 0.0 => 2.0 * x,
                1..=3 => -x,
                n => n as f64,
            }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut count = 0;
            if x > 1.0 { count += 1; }
            if y > 0.0 { count += 2; }
            let side = match (x > 0.0, y > 0.0) {
                (true, true) => 1.0,
                (false, _) => x,
                _ => y,
            };
            let v = 2.0 * x;
            let shadowed = match y { v if v > x => v, _ => v };
            shadowed + side + (0..5).map(|k| mode(k, x - y)).sum::<f64>() + match count { 0 => x, 1 => y, 3 => 5.0, _ => -1.0 }
        }
    }
    defaults_of_every_place {
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
    sums_of_nothing {
        #[derive(Clone, Copy)]
        struct Pair(f64, f64);
        impl std::ops::Add for Pair { type Output = Self; fn add(self, o: Self) -> Self { Pair(self.0 + o.0, self.1 + o.1) } }
        impl std::iter::Sum for Pair {
            fn sum<I: Iterator<Item = Self>>(pairs: I) -> Self { pairs.fold(Pair(0.0, 1.0), |a, b| a + b) }
        }
        fn up_to(j: usize, x: f64) -> f64 { (0..j).map(|i| x + i as f64).sum() }
        pub fn f(x: f64, y: f64) -> f64 {
            let a = [[4.0 + x * x, x, 1.0], [x, 5.0 + y * y, y], [1.0, y, 6.0 + x * x + y * y]];
            let mut l = [[0.0f64; 3]; 3];
            for i in 0..3 {
                for j in 0..=i {
                    let s: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
                    l[i][j] = if i == j { (a[i][i] - s).sqrt() } else { (a[i][j] - s) / l[j][j] };
                }
            }
            let mut n = 3;
            n += (0..0).sum::<i32>();
            let mut later = x;
            later = (1..1).map(|_| y).product();
            let none: Pair = [Pair(x, y); 0].iter().copied().sum();
            let some = [Pair(x, y), Pair(y, 1.0)].into_iter().sum::<Pair>();
            2.0 * (0..3).map(|i| l[i][i].ln()).sum::<f64>() + up_to(0, x) + up_to(2, y) + later * n as f64
                + (0..0).map(|_| x).product::<f64>() + none.1 + some.0 * some.1
        }
    }
    modules_inside {
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
    functions_of_one_name {
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
    iterators {
        fn larger(a: f64, b: f64) -> f64 { if a < b { b } else { a } }
        fn smallest<const N: usize>(values: &[f64; N]) -> Option<f64> { values.iter().copied().reduce(f64::min) }
        pub fn f(x: f64, y: f64) -> f64 {
            let m = [[x, y, 1.0], [y, 2.0, x], [0.5, x * y, -1.0]];
            let square: f64 = m.iter().flatten().map(|v| v * v).sum();
            let (mut level, mut error) = (x, 0.0);
            m[1].iter().skip(1).for_each(|&v| {
                let off = v - level;
                if off < 0.0 { level -= 1.0; }
                error += off * off;
                level += 0.3 * off;
            });
            let mut t = m[2];
            t.iter_mut().enumerate().for_each(|(i, v)| *v *= (i + 1) as f64);
            let nearest = m[0].iter().map(|c| (x - 2.0 * c).powi(2)).min_by(|a, b| a.partial_cmp(b).unwrap()).unwrap();
            let furthest = m[2].into_iter().max_by(|a, b| a.total_cmp(b)).unwrap_or(0.0);
            let at = [(x, 1.0), (y, 2.0), (x, 3.0)];
            let first = at.iter().min_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(std::cmp::Ordering::Equal)).unwrap().1;
            let last = at.iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap().1;
            let back = at.iter().max_by(|a, b| b.0.total_cmp(&a.0)).map(|a| a.1).unwrap();
            let pooled: f64 = [x, y, 1.0, 2.0, y]
                .chunks(2)
                .map(|pair| pair.iter().fold(f64::MIN, |m, v| m.max(*v)))
                .enumerate()
                .map(|(i, m)| (i as f64 + 1.0) * m)
                .sum();
            let zipped: f64 = std::iter::zip([x, y], [y, 3.0]).map(|(a, b)| a * b).sum();
            let lagrange: f64 = (0..3).map(|i| (0..3).filter(|&j| j != i).map(|j| x - j as f64).product::<f64>()).sum();
            let pairs: f64 = (0..3).flat_map(|i| [m[i][0], m[0][i]]).sum();
            let any = m[0].iter().any(|&v| v > 1.5) && !m[1].iter().all(|v| *v > 0.0);
            square + error + level + t[1] - t[2] + nearest + furthest + first + 10.0 * last + 100.0 * back + pooled + zipped
                + lagrange + pairs + if any { 3.0 } else { 0.0 } + smallest(&m[0]).unwrap()
                + [x, y].into_iter().reduce(larger).unwrap() + m[0].first().unwrap() - m[1].last().unwrap()
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
    elements_left_out {
        pub fn f(x: f64, y: f64) -> f64 {
            let xs = [x, y, x * y, 1.0, -x, 0.25 - y];
            let ys = [0.5, x - y, 2.0];
            let positive: f64 = xs.iter().filter(|v| **v > 0.0).sum();
            let product: f64 = xs.iter().copied().filter(|v| v.abs() > 0.5).map(|v| 0.5 + v).product();
            let count = xs.iter().filter(|&&v| v < y).count();
            let roots: f64 = xs.iter().filter_map(|&v| if v >= 0.0 { Some(v.sqrt()) } else { None }).map(|v| v + 1.0).sum();
            let known = (0..6).filter(|i| i % 2 == 0).map(|i| xs[i]).fold(0.0, |a, b| 0.5 * a + b);
            let first: f64 = xs.iter().take_while(|&&v| v < 2.0).sum();
            let rest: f64 = xs.iter().skip_while(|v| **v < 0.4).map(|v| 3.0 * v).sum();
            let mapped: f64 = xs.iter().map_while(|v| (*v > -1.0).then_some(v * v)).sum();
            let chained = xs.iter().filter(|v| **v > 1.0).chain(ys.iter()).fold(1.0, |a, v| a * 0.5 + v);
            let best = xs.iter().filter(|v| **v > 0.1).copied().reduce(f64::min).unwrap_or(-4.0);
            let last = xs.iter().rev().filter(|v| **v < 0.75).last().copied().unwrap_or(11.0);
            let most = xs.iter().filter(|v| **v < y).max_by(|a, b| a.total_cmp(b)).copied().unwrap_or(0.125);
            let found = xs.iter().find(|v| **v > y).copied().unwrap_or(0.5) + xs.iter().filter(|v| **v < x).next().unwrap_or(&3.0);
            let place = xs.iter().position(|v| *v >= 1.0).map_or(9.0, |k| k as f64);
            let root = xs.iter().find_map(|v| if *v > x { Some(0.5 * v) } else { None }).unwrap_or(1.0);
            let any = xs.iter().filter(|v| **v > 0.0).any(|v| *v > 2.0);
            let all = xs.iter().filter(|v| **v > 0.0).all(|v| *v > 0.3);
            let mut loops = 0.0;
            for v in xs.iter().filter(|v| **v < 1.5) {
                if *v < -2.0 { continue; }
                loops = loops * 0.5 + v;
                if loops > 3.0 { break; }
            }
            let mut each = 1.0;
            xs.iter().filter(|v| **v > 0.2).for_each(|v| each = 0.25 * each - v);
            let (odd, even): (Vec<f64>, Vec<f64>) = ys.iter().map(|v| (v + 1.0, v * v)).unzip();
            let numbered: f64 = ys.iter().zip(2..).map(|(v, k)| v * k as f64).sum();
            found + place + root + odd[1] + even.iter().nth(2).unwrap() + numbered + positive + product + 10.0 * count as f64 + roots + known + first + rest + mapped + chained + best + last + most
                + if any { 100.0 } else { 0.0 } + if all { 200.0 } else { 0.0 } + loops + each
        }
    }
    scans {
        pub fn f(x: f64, y: f64) -> f64 {
            let sums: f64 = [x, y, 2.0].iter().scan(0.0, |sum, v| { *sum += v; Some(*sum) }).map(|s| s * s).sum();
            let walk: Vec<f64> = (1..5).scan((x, y), |state, k| {
                let (a, b) = *state;
                *state = (b, 0.5 * a - b / k as f64);
                Some(state.0 + state.1)
            }).collect();
            let until: f64 = [x, y, x + y].into_iter().scan(1.0, |left, v| {
                *left -= 0.25 * v;
                if *left < 0.0 { None } else { Some(*left) }
            }).sum();
            sums + walk[0] - walk[3] + until
        }
    }
    lists {
        fn powers(x: f64, count: usize) -> Vec<f64> {
            let mut all = Vec::with_capacity(count);
            let mut power = 1.0;
            for _ in 0..count {
                all.push(power);
                power *= x;
            }
            all
        }
        fn dot(a: &[f64], b: &[f64]) -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() }
        fn median(values: &[f64]) -> f64 {
            let mut sorted = values.to_vec();
            sorted.sort_by(|a, b| a.partial_cmp(b).unwrap());
            let middle = sorted.len() / 2;
            if sorted.len() % 2 == 0 { 0.5 * (sorted[middle - 1] + sorted[middle]) } else { sorted[middle] }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let halves: Vec<f64> = powers(x, 4).iter().map(|p| 0.5 * p).collect();
            let mut grid = vec![vec![0.0; 3]; 2];
            grid[1][2] = y;
            grid[0].fill(x);
            let mut all = vec![x, y];
            all.extend(halves.iter().rev().skip(1));
            all.extend_from_slice(&grid[1]);
            let dropped = all.pop().unwrap();
            let even = median(&all[..4]);
            all.reverse();
            all.truncate(5);
            let mut more: Vec<f64> = Vec::new();
            if more.is_empty() { more.push(dropped); }
            let squares = all.iter().map(|v| v * v).collect::<Vec<_>>();
            let three: [f64; 3] = squares[..3].to_vec().try_into().unwrap();
            let mut numbers = [3, 1, 2];
            numbers.sort();
            dot(&all, &squares) + even + median(&all) + more[0] + three[1] + grid.iter().flatten().sum::<f64>()
                + x * numbers[2] as f64
        }
    }
    closures_that_change_what_is_outside {
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
    tables {
        const TABLE: [f64; 5] = [1.0, -2.0, 0.5, 4.0, 3.0];
        fn lookup(x: f64) -> f64 {
            let position = (x + 3.0) * 0.6;
            let i = (position.floor() as usize).min(TABLE.len() - 2);
            let t = position - i as f64;
            TABLE[i] * (1.0 - t) + TABLE[i + 1] * t
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let bin = (2.0 * y) as i32;
            let parity = [1.0, 0.5, -0.25][((bin + 12) % 3) as usize];
            lookup(x) + 10.0 * lookup(y) + bin as f64 + parity + (bin / 2) as f64 + (300.0 * x) as u8 as f64 + (100.0 * y) as i8 as f64
        }
    }
    loops_that_arguments_end {
        pub fn f(x: f64, y: f64) -> f64 {
            let (mut a, mut b, mut n) = (0.0, 0.0, 0);
            while n < 7 && a * a + b * b < 4.0 {
                (a, b) = (a * a - b * b + 0.3 * x, 2.0 * a * b + 0.3 * y);
                n += 1;
            }
            let mut left = vec![x, y, 1.0];
            let mut sum = 0.0;
            while let Some(v) = left.pop() {
                if v > 2.0 { sum -= 3.0; continue; }
                sum = 0.5 * sum + v;
            }
            let mut k = 0;
            while k < 4 {
                k += 1;
                if k == 2 { continue; }
                sum += 0.1 * k as f64;
            }
            a + b + 2f64.powi(n - 3) + sum
        }
    }
    recursion_that_ends {
        fn basis(i: usize, p: usize, t: f64) -> f64 {
            if p == 0 { return if i as f64 <= t && t < (i + 1) as f64 { 1.0 } else { 0.0 }; }
            let d = p as f64;
            (t - i as f64) / d * basis(i, p - 1, t) + ((i + p + 1) as f64 - t) / d * basis(i + 1, p - 1, t)
        }
        fn power(x: f64, n: u32) -> f64 {
            match n { 0 => 1.0, n if n % 2 == 0 => power(x * x, n / 2), n => x * power(x, n - 1) }
        }
        pub fn f(x: f64, y: f64) -> f64 { (0..5).map(|i| basis(i, 3, x + 1.5) * (i as f64 - y)).sum::<f64>() + power(y, 11) }
    }
    chosen_elements {
        fn solve(mut a: [[f64; 3]; 3], mut b: [f64; 3]) -> [f64; 3] {
            for c in 0..3 {
                let pivot = (c..3).max_by(|&i, &j| a[i][c].abs().partial_cmp(&a[j][c].abs()).unwrap()).unwrap();
                a.swap(c, pivot);
                b.swap(c, pivot);
                for r in c + 1..3 {
                    let k = a[r][c] / a[c][c];
                    for j in c..3 { a[r][j] -= k * a[c][j]; }
                    b[r] -= k * b[c];
                }
            }
            let mut x = [0.0; 3];
            for i in (0..3).rev() {
                let s: f64 = (i + 1..3).map(|j| a[i][j] * x[j]).sum();
                x[i] = (b[i] - s) / a[i][i];
            }
            x
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut bins = [[0.0; 2]; 4];
            for v in [x, y, 0.5 * x] { bins[((v + 4.0) * 0.4) as usize % 4][(v > 0.0) as usize] += 1.0 + 0.1 * v; }
            let [p, q, r] = solve([[x + 5.0, 1.0, y], [2.0, y - 6.0, x], [0.5, x, 8.0]], [1.0, x, y]);
            let eye: [[f64; 3]; 2] = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { x } else { y }));
            let four = std::array::from_fn::<f64, 4, _>(|i| i as f64 + x);
            let mut kept = [0.0; 4];
            kept.copy_from_slice(&four);
            let mut more = vec![x, y, 3.0];
            more.pop();
            std::mem::replace(&mut more[0], 2.0);
            kept[0] += more.iter().sum::<f64>();
            let before = std::mem::replace(&mut kept[1], y);
            bins[1][0] + 2.0 * bins[2][1] - bins[3][1] + bins[0][0] + p + 2.0 * q - r + eye[1][1] - eye[0][2] + kept[1] - kept[3] * before
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
    patterns_of_several {
        pub fn f(x: f64, y: f64) -> f64 {
            let first = if x > 0.0 { Some(x) } else { None };
            let second = if y > 0.0 { Some(y) } else { None };
            match (first, second) { (Some(v), _) | (None, Some(v)) => 2.0 * v, (None, None) => x - y }
        }
    }
    slices_and_whole_numbers {
        fn at(table: &[(f64, f64)], t: f64) -> f64 {
            let after = table.partition_point(|(time, _)| *time <= t).clamp(1, table.len() - 1);
            let ((t0, a), (t1, b)) = (table[after - 1], table[after]);
            a + (b - a) * (t - t0) / (t1 - t0)
        }
        fn head(values: &[f64]) -> f64 {
            let Some((first, rest)) = values.split_first() else { return 0.0 };
            first - 0.5 * head(rest)
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let table = [(-2.0, 1.0), (-0.5, x), (1.0, -1.0), (2.5, y)];
            let all = [[x, y], [1.0, 2.0]].concat();
            let (one, other) = all.split_at(1);
            let mut turned = all.clone();
            turned.rotate_left(1);
            let cell = (x * 2.0).floor() as i32;
            let wrapped = cell.rem_euclid(4) + cell.signum() + cell.div_euclid(3) + cell.abs_diff(2) as i32;
            let ramp: Vec<f64> = std::iter::once(x).chain(std::iter::repeat_n(y, 2)).collect();
            let f: Box<dyn Fn(f64) -> f64> = Box::new(move |v| v * x);
            at(&table, y) + head(&all) + one[0] * other[2] + turned[0] + wrapped as f64 + ramp[2] + f(y)
                + if [1, 2, 3].contains(&cell) { 5.0 } else { 0.0 }
        }
    }
    effects_where_they_happen {
        #[derive(Clone, Copy, PartialEq, Default)]
        struct Counter { n: f64, last: Option<f64> }
        impl Counter {
            fn hit(&mut self, v: f64) -> bool { self.n += v; v > 0.0 }
            fn next(&mut self) -> usize { self.n += 1.0; self.last = None; 0 }
        }
        fn early(x: f64, y: f64) -> f64 {
            let o = if y > 0.0 { Some(y) } else { None };
            let _positive = x > 0.0 || return 3.0 * y;
            let p = || -> Option<f64> { if x > 1.5 && o? > 0.6 { Some(9.0) } else { Some(1.0) } };
            p().unwrap_or(-5.0)
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut c = Counter { n: 0.0, ..Default::default() };
            if c.hit(x) && c.hit(y) || c.hit(2.0) { c.n += 10.0; }
            let mut n = 0.0;
            let mut hit = |v: f64| { n += v; v > 0.0 };
            let both = hit(x) && hit(10.0 * y);
            let mut k = 0;
            while k < 4 && hit(y - k as f64) { k += 1; }
            let o = if x > 0.5 { Some(x) } else { None };
            let mut seen = 0.0;
            let mapped = o.map(|v| { seen += v; v * v }).unwrap_or_else(|| { seen -= 7.0; y });
            let guarded = match o { Some(v) if { seen += 0.5; v > 1.0 } => v, Some(_) => -1.0, None => 4.0 };
            let mut v = [x, y, 3.0];
            let mut i = 1;
            v[i] += { i = 2; 0.5 };
            v[c.next()] *= 2.0;
            c.n += if c.hit(y) { c.n } else { -c.n };
            c.last = Some(x);
            let old = c.last.replace(y).unwrap() + c.last.take().unwrap_or(0.0);
            let roots: Option<Vec<f64>> = [x + 1.0, y + 2.0].iter().map(|v| (*v > 0.0).then(|| v.sqrt())).collect();
            let more = [x, y].iter().map(|v| if *v > 0.0 { Some(*v) } else { None }).collect::<Option<Vec<_>>>();
            c.n += roots.map_or(0.5, |roots| roots[0] - roots[1]) + more.map_or(-1.0, |v| v.iter().sum());
            let near = (0..3).filter(|&j| j + 1 < 3 && v[j + 1] > v[j]).count();
            let mut previous: Option<f64> = None;
            let mut rises = 0.0;
            for w in v { match previous { Some(p) if w > p => rises += w - p, _ => {} } previous = Some(w); }
            let kept = o.filter(|v| *v < 2.5).or(Some(0.25)).is_some_and(|v| v > 0.7);
            c.n + n + early(x, y) + early(y, x) + mapped + guarded + seen + v[0] + v[1] * v[2] + old + near as f64 + rises + k as f64
                + if both { 100.0 } else { 0.0 } + if kept { 200.0 } else { 0.0 } + if c.last.is_some() { 1e3 } else { 0.0 }
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
    what_traits_provide {
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
    what_goes_elsewhere {
        #[derive(Clone, Copy, PartialEq)]
        struct P { x: f64, y: f64 }
        struct Q(f64);
        impl PartialEq<Q> for P { fn eq(&self, other: &Q) -> bool { self.x == other.0 } }
        fn pair(a: &[f64; 3], i: usize) -> Option<f64> { Some(a.get(i)? + a.get(i + 1)?) }
        fn root(x: f64) -> Result<f64, String> { if x < 0.0 { Err(String::new()) } else { Ok(x.sqrt()) } }
        fn positive(x: f64) -> Option<f64> { (x > 0.0).then_some(x) }
        fn checked(x: f64) -> Option<f64> { positive(x)?; Some(2.0 * x) }
        pub fn f(x: f64, y: f64) -> f64 {
            let a = [x, y, 2.0];
            let mut total = 0.0;
            for k in 0..3 { total += if k == 1 { continue } else { x }; }
            let none = if x > 0.0 { [1, 2].iter().find_map(|n| if *n > 5 { Some(y) } else { None }).unwrap_or(x) } else { y };
            let mut n = 0.0;
            let taken: f64 = a.iter().take_while(|v| { n += 1.0; **v > 0.0 }).sum();
            let g = { let a = x; let b = a + a; let _ = b; |b: f64| b * b };
            let at = a.get((x as i32 + 1) as usize).copied().unwrap_or(7.0);
            let found = [x, 9.0].into_iter().find(|v| *v > 1.0).unwrap_or_else(|| panic!("one is"));
            let equal = |truth: bool| if truth { 1.0 } else { 0.0 };
            let (p, q) = (P { x, y }, P { x, y: 0.5 });
            (0..3).filter_map(|i| pair(&a, i)).sum::<f64>() + total + none + taken + n + g(y) + found + at
                + root(x).unwrap_or_else(|_| 0.25) + checked(y).unwrap_or(0.0) + equal(p == q) + 2.0 * equal(p == Q(1.0))
        }
    }
}

//! Tests of patterns: imported names, alternatives with a guard, bindings.

use super::same;

same! {
    imported_variants {
        use std::cmp::Ordering::{self, *};
        fn sign(x: f64, y: f64) -> f64 { match x.total_cmp(&y) { Less => x, Equal => y, Greater => x * y } }
        fn other(x: f64, y: f64) -> f64 {
            use std::cmp::Ordering::{Greater as More, Less as Fewer};
            if let Some(Fewer) = x.partial_cmp(&y) { return x - y; }
            match x.partial_cmp(&1.0) { Some(More) => 3.0 * x, Some(Ordering::Less) => y, _ => 7.0 }
        }
        fn inside(x: f64, y: f64) -> f64 {
            use std::cmp::Ordering::*;
            let order = if x > 1.0 { Greater } else { Equal };
            let both = order.then(x.total_cmp(&y));
            let back = Equal.then_with(|| y.total_cmp(&x));
            let least = if both.is_le() && back.is_ne() { 3.0 } else { 4.0 };
            least * match both { Less => x, Greater => 2.0 * y, Equal => 5.0 }
        }
        pub fn f(x: f64, y: f64) -> f64 { sign(x, y) + 10.0 * other(x, y) + 100.0 * inside(x, y) }
    }
    imported_constants {
        use std::f64::consts::*;
        mod limits { pub const LEAST: i32 = 2; }
        use limits::LEAST;
        fn count(n: i32) -> f64 { match n { LEAST => 10.0, 3 => 20.0, _ => 30.0 } }
        pub fn f(x: f64, y: f64) -> f64 {
            let at = if x > 0.0 { PI } else { x };
            let near = match at { PI => y, _ => x };
            const FEW: i32 = 3;
            let inner = |n: i32| match n { FEW => x, _ => y };
            near + count(2) + count(if y > 0.0 { 3 } else { 4 }) + inner(3) * inner(if x > y { 3 } else { 1 })
        }
    }
    guards_are_evaluated_for_each_alternative {
        fn larger(x: f64, y: f64) -> f64 { match (x, y) { (a, _) | (_, a) if a > 0.9 => a * a, _ => x - y } }
        fn some(p: Option<f64>, q: Option<f64>) -> f64 {
            match (p, q) { (Some(a), _) | (_, Some(a)) if a > 1.0 => a, (None, None) => 50.0, _ => -1.0 }
        }
        fn nested(v: [(f64, f64); 2]) -> f64 {
            match v { [(a, _) | (_, a), (_, b) | (b, _)] if a > b => a - 3.0 * b, _ => 11.0 }
        }
        fn is_one(n: i32, x: f64) -> bool { matches!((n, x), (1 | 2, a) | (3, a) if a > 0.0) }
        pub fn f(x: f64, y: f64) -> f64 {
            let some_if = |v: f64| if v > -1.0 { Some(v) } else { None };
            let n = if x > y { 3 } else { 4 };
            larger(x, y) + 10.0 * some(some_if(x), some_if(y)) + nested([(x, y), (1.0, y)]) + if is_one(n, y) { 9.0 } else { x }
        }
    }
    bindings_with_at {
        pub fn f(x: f64, y: f64) -> f64 {
            let n = if x > 1.0 { 5 } else if y > 0.0 { 2 } else { 0 };
            let by_count = match n { small @ 1..=3 => f64::from(small) * x, all @ (4 | 5) => f64::from(all) * y, _ => 0.5 };
            let pair = match (x, y) { whole @ (a, _) if a > 0.0 => whole.0 * whole.1, whole => whole.1 };
            by_count + pair
        }
    }
    bindings_with_capital_letters {
        pub fn f(x: f64, y: f64) -> f64 {
            let K = 1.0;
            let matched = match y { K if K > x => x * y, _ => x };
            let (R, T) = (x + K, y);
            matched + match R { T => T * 3.0 }
        }
    }
    unit_struct_patterns {
        struct Marker;
        pub fn f(x: f64, y: f64) -> f64 { match (Marker, x) { (Marker, a) if a > 0.0 => a * y, (Marker, _) => y } }
    }
    rest_patterns {
        struct P(f64, f64, f64);
        enum V { A(f64, f64, f64), B }
        fn of_tuples(t: (f64, f64, f64)) -> f64 { match t { (a, ..) if a > 0.0 => a, (.., c) => c } }
        fn of_structs(p: P) -> f64 { match p { P(a, ..) if a > 1.0 => a, P(.., c) => 3.0 * c } }
        fn of_variants(v: V, x: f64) -> f64 { match v { V::A(.., c) if c > x => c, V::A(a, ..) => a, V::B => 7.0 } }
        pub fn f(x: f64, y: f64) -> f64 {
            let (a, .., c) = (x, y, 3.0);
            let P(.., d) = P(x, y, x * y);
            let P(e, ..) = P(x, 1.0, y);
            let v = if x > y { V::A(x, y, 2.0) } else { V::B };
            let some = if x > 0.0 { Some((x, y)) } else { None };
            let is_some = if let Some(..) = some { 10.0 } else { y };
            let sum: f64 = [(x, y, 1.0), (y, x, 2.0)].iter().map(|(first, .., last)| first * last).sum();
            a + c * d + e + of_tuples((x, y, 2.0)) + 10.0 * of_structs(P(x, y, 2.0)) + of_variants(v, x) * is_some + sum
        }
    }
    guards_run_only_where_earlier_guards_failed {
        pub fn f(x: f64, y: f64) -> f64 {
            let mut asked = 0.0;
            let mut is_large = |v: f64| { asked += 1.0; v > 0.6 };
            let found = match (x, y) { (a, _) | (_, a) if is_large(a) => a, _ => -1.0 };
            found + 100.0 * asked
        }
    }
}

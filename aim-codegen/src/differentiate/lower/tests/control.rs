//! Tests of branches, loops, early exits, and their effects on variables.

use super::same;

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
    loops_with_break_continue_and_return {
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
    assignments_before_break_and_continue {
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
    bits_and_other_functions_of_known_integers {
        pub fn f(x: f64, y: f64) -> f64 {
            const SCALE: i32 = 1 << 10;
            let mut sum = x * SCALE as f64;
            for i in 0..9_usize {
                if i & 1 == 0 { sum += y; } else { sum -= x * y; }
                sum += (i ^ 5 | 2) as f64 * x + (i >> 1 << 2) as f64;
                if i.is_multiple_of(3) || i.is_power_of_two() { sum *= 1.25; }
                sum += (i.div_ceil(2) + i.isqrt()) as f64 * y + (i + 1).ilog2() as f64;
            }
            let mut bits = 0b1011_i32;
            let mut odd = false;
            while bits != 0 {
                bits &= bits - 1;
                odd ^= true;
            }
            bits |= 4;
            bits ^= -3;
            bits >>= 1;
            bits <<= 3;
            sum + bits as f64 + if odd { x } else { y }
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
    loops_ended_by_arguments {
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
    bounded_recursion {
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
    side_effects_of_conditions_closures_and_indices {
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
    early_exits_options_and_results {
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
    or_patterns {
        pub fn f(x: f64, y: f64) -> f64 {
            let first = if x > 0.0 { Some(x) } else { None };
            let second = if y > 0.0 { Some(y) } else { None };
            match (first, second) { (Some(v), _) | (None, Some(v)) => 2.0 * v, (None, None) => x - y }
        }
    }
    loops_with_values {
        pub fn f(x: f64, y: f64) -> f64 {
            let mut n = 0;
            let found = loop {
                n += 1;
                if n as f64 > x + 2.0 { break y * n as f64; }
                if n == 4 { break if y > 0.0 { x } else { -1.0 }; }
            };
            let first = 'outer: loop {
                for i in 0..4 { if i as f64 * 0.7 > y { break 'outer Some(i as f64); } }
                break None;
            };
            let always = loop { break x * y; };
            found + 10.0 * first.unwrap_or(-2.0) + 100.0 * n as f64 + always
        }
    }
    reflections {
        fn cdf(x: f64) -> f64 {
            if x < 0.0 { return 1.0 - cdf(-x); }
            let t = 1.0 / (1.0 + 0.2316419 * x);
            1.0 - 0.4 * (-0.5 * x * x).exp() * t
        }
        fn gamma(z: f64) -> f64 {
            if z < 0.5 { 3.0 / ((3.0 * z).sin() * gamma(1.0 - z)) } else { (z - 0.5).exp() * z }
        }
        fn odd(x: f64) -> f64 {
            match x { x if x > 0.0 => x.sqrt(), x if x >= 0.0 => 7.0, x => -odd(-x) }
        }
        pub fn f(x: f64, y: f64) -> f64 { cdf(x) + 2.0 * cdf(y - 0.5) + gamma(x + 0.1) + odd(y) }
    }
    conditions_decided_by_earlier_branches {
        fn g(x: f64, n: i32) -> f64 { if n == 0 { return x; } if x > 1.0 { g(x - 1.0, n - 1) } else if x < -1.0 { -g(-x, n - 1) } else { x * 3.0 } }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut z = x;
            let mut out = 0.0;
            if z > 0.5 { z -= 2.0; if z > 0.5 { out += 1.0; } else { out += 2.0; } if z + 2.0 > 0.5 { out += 4.0; } }
            if x <= 1.0 { if x < 1.0 { out += 8.0; } if x >= 1.0 { out += 16.0; } if x > 1.0 { out += 32.0; } if x <= 1.0 { out += 64.0; } }
            if 2.0 * y < 1.5 { if y < 0.75 { out += 128.0; } if -y > -0.75 { out += 256.0; } if 3.0 - y < 2.25 { out += 512.0; } if y < 0.5 { out += 1024.0; } }
            for k in 0..3 { if y > k as f64 * 0.4 { out += if y > 0.1 { 0.5 } else { 0.25 }; if y < 0.0 { break; } } else { out -= 0.125; } }
            out + z + g(x, 3) + g(y, 2)
        }
    }
    loops_with_bounded_iteration_counts {
        fn below(n: usize) -> usize { if n > 4 { return 4; } n }
        fn factorial(n: usize) -> f64 { if n == 0 { 1.0 } else { n as f64 * factorial(n - 1) } }
        fn power(x: f64, n: usize) -> f64 { match n { 0 => 1.0, 1 => x, n => x * power(x, n - 1) } }
        pub fn f(x: f64, y: f64) -> f64 {
            let n = x.abs().floor().min(3.0) as usize;
            let m = (y.clamp(-2.0, 2.0).floor() as i32 + 2) as usize;
            let (mut sum, table) = (0.0, [0.5, -1.0, 2.0, 4.0, 8.0]);
            for i in 0..n { sum += table[i] * x; }
            for i in n..=m { sum += table[i] * y; if sum > 20.0 { break; } }
            for i in (m.min(2)..m + n).rev() { sum -= i as f64; }
            for i in 0..below(m + n) { sum += table[i]; for j in i..m.min(3) { sum -= 0.25 * table[j] * y; } }
            let mut i = 0;
            while i < m { sum += 0.125 * table[i]; i += 1; }
            let halves: f64 = (0..n).map(|i| x.powi(i as i32) * 0.5).sum();
            let k = (10.0 + x + y).floor() as usize;
            assert!(k < 30 && k > 2, "between these");
            for j in 0..k / 4 { sum += 0.01 * j as f64; }
            if k >= 12 && k < 14 { for j in 12..k { sum += 100.0 * j as f64; } }
            sum += factorial(n) + power(y, m);
            sum + halves + (0..n).len() as f64 + if (0..m).any(|i| table[i] > y) { 7.0 } else { 9.0 }
        }
    }
    indices_with_side_effects {
        struct Gen { s: [f64; 3], i: usize }
        impl Gen {
            fn step(&mut self) -> usize { self.i = (self.i + 1) % 3; self.s[self.i] *= 0.5; self.s[self.i] += 1.0; self.i }
            fn next(&mut self) -> f64 { self.s[self.step()] }
        }
        fn late(v: &mut [f64; 3], o: Option<usize>, n: &mut f64) -> Option<f64> { v[o?] = { *n += 1.0; *n }; Some(v[0]) }
        fn later(v: &mut [f64; 3], o: Option<usize>, n: &mut f64) -> Option<f64> { v[o?] = raised(n); Some(v[0]) }
        fn raised(n: &mut f64) -> f64 { *n += 2.0; *n }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut g = Gen { s: [x, y, x * y], i: 0 };
            let mut sum = g.next() + 10.0 * g.next() + 100.0 * g.next();
            let mut v = [x, y, 2.0];
            sum += v[{ v[0] = 5.0 * y; 0 }] + v[1];
            let mut n = 1.0;
            sum += late(&mut v, None, &mut n).unwrap_or(0.25) + later(&mut v, None, &mut n).unwrap_or(0.5);
            sum += late(&mut v, Some(0), &mut n).unwrap_or(0.25) + later(&mut v, Some(1), &mut n).unwrap_or(0.5);
            sum + 1000.0 * n + v[1]
        }
    }
    negative_integers_cast_to_unsigned {
        pub fn f(x: f64, y: f64) -> f64 {
            let v = [x, y, 2.0, x * y];
            let mut sum = 0.0;
            for i in 0..4usize {
                for d in [-1i32, 1] {
                    let k = (i as i32 + d) as usize;
                    if k < 4 { sum += v[i] * v[k]; }
                    sum += v[((i as i32 + d) as usize).min(3)];
                }
            }
            let k = (x.floor() as i32 - 1) as usize;
            let m = (y.floor() as i64) as u32;
            sum + if k < 2 { y } else { 7.0 } + if m > 5 { 0.5 } else { m as f64 } + v[k.min(2)]
        }
    }
    min_and_max_ignore_nan {
        pub fn f(x: f64, y: f64) -> f64 {
            let v = [x, y, 0.5];
            let most = v.iter().copied().fold(f64::NAN, f64::max);
            let least = v.iter().copied().fold(f64::NAN, |a, b| b.min(a));
            let mut s = 0.0;
            let n = v.iter().map(|a| a * 2.0).len();
            s += (0.7 / 0.1f64) as usize as f64 + (2.5f64.floor() as i32 % 2) as f64;
            most + 10.0 * least + n as f64 + s
        }
    }
    conditions_known_only_in_a_branch {
        pub fn f(x: f64, y: f64) -> f64 {
            let mut sum = 0.0;
            for k in 0..2 {
                if x > 1.5 { sum += 1.0; continue; }
                if x > 2.5 { sum += 1000.0; }
                if y > 0.5 { if x > 0.75 { break; } if x > 0.9 { sum += 500.0; } }
                if x > 0.8 { sum += 3.0 + k as f64; }
            }
            if x > 1.75 { sum += 10.0; }
            if x > 0.9 { sum += 100.0; }
            let y = if y > 1.0 { y - 4.0 } else { y };
            let g = |z: f64| { if z > 0.0 { return 1.0; } if z > -1.0 { 2.0 } else { 3.0 } };
            sum + g(x) + 0.1 * g(y) + if y > 1.0 { 0.01 } else { 0.02 }
        }
    }
}

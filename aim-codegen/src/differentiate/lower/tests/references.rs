//! Tests of mutable references: moved, destructured, returned.

use super::same;

same! {
    loops_over_mutable_references {
        struct Body { at: f64 }
        impl Body { fn up(&mut self, by: f64) { self.at += by; } }
        fn each(rows: &mut [[f64; 2]], by: f64) { for row in rows { row[0] += by; } }
        fn all(bodies: &mut [Body], by: f64) { for body in bodies { body.up(by); body.at *= 2.0; } }
        fn plain(values: &mut [f64]) { for v in values { *v += 1.0; } }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut rows = [[x, y], [y, 1.0]];
            each(&mut rows, 10.0);
            let [_, rest @ ..] = &mut rows;
            for row in rest { row[1] += x; }
            let mut cubes = [[[x, y]; 2]; 2];
            for plane in &mut cubes { for row in plane { row[0] += y; } }
            let mut bodies = [Body { at: x }, Body { at: y }];
            all(&mut bodies, y);
            let mut values = [x, y];
            plain(&mut values);
            let (before, after) = values.split_at_mut(1);
            for v in after { *v *= before[0]; }
            let up = |row: &mut [f64; 2]| row[0] += 10.0;
            for row in rows.iter_mut() { up(row); }
            rows[0][0] + rows[1][1] * cubes[1][0][0] + bodies[0].at * bodies[1].at + values[1]
        }
    }
    references_moved_between_variables {
        fn apply(v: &mut [f64; 2], g: impl Fn(&mut [f64; 2])) { g(v); }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut v = [x, y];
            let r = &mut v;
            let (a, k) = (r, 10.0);
            a[0] += k;
            apply(&mut v, |p| p[0] += y);
            let (p, q) = v.split_at_mut(1);
            let (a, b) = (q, p);
            a[0] += b[0];
            let r = &mut v;
            if let Some(a) = Some(r) { a[0] += 10.0; }
            let r = &mut v;
            let a = { r };
            a[1] *= 2.0;
            let mut u = [x, y];
            let p = &mut u;
            for r in [p] { r[0] += 10.0; }
            let (mut s, mut t, mut w) = ([x, 1.0, 2.0], [y, 3.0, 4.0], [5.0; 3]);
            let [_, rest @ ..] = [&mut w[0], &mut t[0], &mut s[2]];
            let [q, r] = rest;
            *q += 10.0;
            *r += 100.0;
            v[0] + v[1] * u[0] + s[2] + 1000.0 * t[1] + t[0]
        }
    }
    references_returned_by_functions {
        struct Body { at: f64, speed: f64 }
        impl Body {
            fn moved(&mut self, by: f64) -> &mut Self { self.at += by; self }
            fn speed_mut(&mut self) -> &mut f64 { &mut self.speed }
        }
        fn pick<'a>(a: f64, b: f64, v: &'a mut [f64; 2]) -> &'a mut f64 { if a == b { return &mut v[0]; } &mut v[1] }
        fn row(rows: &mut [[f64; 2]; 2]) -> &mut [f64; 2] { &mut rows[1] }
        fn same(v: &mut [f64; 2]) -> &mut [f64; 2] { v }
        fn halves(v: &mut [f64]) -> (&mut [f64], &mut [f64]) { v.split_at_mut(1) }
        fn found(v: &mut [f64], at: usize) -> Option<&mut f64> { v.get_mut(at) }
        fn go(old: [[f64; 2]; 2], other: Body) -> f64 {
            let mut rows = old;
            let r = row(&mut rows);
            r[0] += 10.0;
            let mut body = Body { at: old[0][0], speed: old[0][1] };
            *body.speed_mut() += 10.0;
            body.moved(1.0).moved(2.0);
            let last = body.moved(3.0);
            last.speed *= 2.0;
            rows[1][0] + 100.0 * old[1][0] + body.at * body.speed + 10.0 * other.speed + other.at
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let o = [100.0, 200.0];
            let mut v = [x, y];
            *pick(1.0, 2.0, &mut v) += 10.0;
            let a = same(&mut v);
            a[0] += 5.0;
            let (one, two) = halves(&mut v);
            one[0] *= two[0];
            if let Some(w) = found(&mut v, 1) { *w += x; }
            if found(&mut v, 2).is_some() { v[0] = 0.0; }
            go([[x, y], [y, 1.0]], Body { at: y, speed: x }) + v[0] + v[1] * 3.0 + o[1]
        }
    }
    references_destructured_by_patterns {
        struct Spring { ends: [f64; 2], k: f64 }
        enum Mode { Row([f64; 2]), One(f64), Both { a: f64, b: f64 }, Rest }
        impl Spring { fn go(&mut self) { match self { Spring { ends, k } => { ends[0] += *k; *k *= 2.0; } } } }
        impl Mode {
            fn go(&mut self, by: f64) {
                match self {
                    Mode::Row(v) => v[0] += by,
                    Mode::One(k) => *k *= by,
                    Self::Both { a, .. } if *a > 0.0 => *a = by,
                    Self::Both { b, .. } => *b += by,
                    Mode::Rest => *self = Mode::One(by),
                }
            }
            fn value(&self) -> f64 {
                match self { Mode::Row(v) => v[0] + v[1], Mode::One(k) => *k, Mode::Both { a, b } => a * b, Mode::Rest => 0.0 }
            }
        }
        fn opened(o: &mut Option<[f64; 2]>, by: f64) { if let Some(v) = o { v[0] += by; } }
        fn of_kind(v: &mut [f64; 2]) { match v { a if a[0] > 0.0 => a[0] += 10.0, a => a[1] += 10.0 } }
        fn sum(v: &[f64]) -> f64 { if let [a, rest @ ..] = v { a + sum(rest) } else { 0.0 } }
        fn shifted(v: &mut [f64]) { match v { [a, rest @ ..] => { *a += 1.0; rest[0] -= *a; } [] => {} } }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut spring = Spring { ends: [x, y], k: 3.0 };
            spring.go();
            let mut modes = [Mode::Row([x, y]), Mode::One(y), Mode::Both { a: x, b: y }, Mode::Rest];
            for mode in &mut modes { mode.go(y); }
            let mut chosen = if x > 0.0 { Mode::One(x) } else { Mode::Row([y, x]) };
            chosen.go(2.0);
            let mut o = if y > 0.0 { Some([x, y]) } else { None };
            opened(&mut o, 10.0);
            let mut p = Some(y);
            if let Some(w) = &mut p { *w += x; }
            let mut v = [x, y];
            of_kind(&mut v);
            shifted(&mut v);
            let Some(&mut w) = v.first_mut() else { return 0.0 };
            v[0] += 10.0;
            let before = if let (&mut a, true) = (&mut v[1], true) { v[1] += 10.0; a } else { 0.0 };
            let total: f64 = modes.iter().map(|mode| mode.value()).sum();
            spring.ends[0] * spring.k + total + chosen.value() + o.map_or(2.0, |v| v[0]) + p.unwrap_or(0.0) + sum(&v) * w + before
        }
    }
    copies_of_referenced_values {
        pub fn f(x: f64, y: f64) -> f64 {
            let mut v = [x, y, 1.0];
            let (mut s, mut t) = (0.0, 0.0);
            for w in v.iter_mut() { let old = *w; *w += y; s += old * *w; let z = *w; *w *= z; t += z; }
            let r = &mut v[1..];
            let head = r[0];
            r[0] = x;
            t += head * r[0];
            if let [a, b] = *r { r[0] += 5.0; t += a * b; }
            let q = *r.first_mut().unwrap();
            r[0] += 1.0;
            s += q - *r.last_mut().unwrap();
            let q = { let w = &mut r[1]; *w += 1.0; *w };
            r[1] *= 2.0;
            s + q * t + v[0] + v[1] * v[2]
        }
    }
    variants_that_are_never_constructed {
        #[derive(Clone, Copy)]
        enum S { A, B, On(f64) }
        impl S { fn go(&mut self) { match self { S::On(k) => *k += 1.0, S::A => *self = S::B, S::B => {} } } }
        pub fn f(x: f64, y: f64) -> f64 {
            let s = if x > 1.0 { S::A } else { S::B };
            let mut u = match s { S::On(k) => S::On(k), S::A => S::B, S::B => S::A };
            u.go();
            let v = if let S::On(k) = u { k } else { y };
            v + match s { S::On(k) => k, S::A => y, S::B => x } + match u { S::A => 1.0, S::B => 2.0, S::On(k) => k }
        }
    }
}

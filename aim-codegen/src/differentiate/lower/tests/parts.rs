//! Tests of changing parts of arrays.

use super::same;

same! {
    parts_of_arrays_are_changed {
        fn relax(part: &mut [f64]) {
            for v in part.iter_mut() { *v *= 0.5; }
            part[0] += 1.0;
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut v = [x, y, x * y, 2.0 * x, 3.0 * y, 1.0];
            v[3..].iter_mut().for_each(|w| *w += y);
            for w in &mut v[1..4] { *w *= 2.0; }
            for w in v[..=1].iter_mut() { *w -= x; }
            v[..2].fill(y);
            v[1..].reverse();
            let source = [y, x, 4.0];
            v[2..5].copy_from_slice(&source[0..3]);
            v[1..4].swap(0, 2);
            relax(&mut v[2..]);
            relax(&mut v);
            let part = &mut v[1..3];
            part[1] += x;
            part[0] = part[1] * y;
            let inner = &mut part[1..];
            inner[0] += 0.25;
            v.iter().enumerate().map(|(i, w)| (i + 1) as f64 * w).sum()
        }
    }
    parts_at_computed_indices {
        pub fn f(x: f64, y: f64) -> f64 {
            let mut v = [1.0, 2.0, 3.0, 4.0, 5.0];
            let k = if x > 0.0 { 1 } else { 2 };
            v[1..4][k] *= x;
            if y > 0.0 { v[2..].fill(y); } else { v[..2].fill(x); }
            if let Some(w) = v.get_mut(k + 2) { *w += 10.0 * y; }
            if let Some(w) = v.get_mut(k + 3) { *w += 100.0; } else { v[0] += 7.0; }
            if let Some(w) = v.get_mut(5) { *w = 0.0; }
            v.iter().enumerate().map(|(i, w)| (i + 1) as f64 * w).sum()
        }
    }
    changes_through_references_returned_by_methods {
        struct Row { cells: [f64; 4], total: f64 }
        impl Row {
            fn largest(&mut self) -> &mut f64 { self.cells.last_mut().unwrap() }
        }
        fn last(v: &mut [f64]) -> Option<f64> {
            *v.last_mut()? += 1.0;
            let end = v.last_mut()?;
            *end *= 2.0;
            Some(*end)
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut v = [x, y, 1.0, 2.0, x * y];
            *v.first_mut().unwrap() += 3.0;
            *v.last_mut().unwrap() = 2.0 * y;
            if let Some(w) = v.first_mut() { *w *= y; }
            let (before, after) = v.split_at_mut(2);
            before[0] += after[1];
            after[2] -= before[1];
            core::mem::swap(&mut before[1], &mut after[0]);
            if let Some((first, rest)) = v.split_first_mut() {
                for w in rest.iter_mut() { *w += *first; }
                rest[0] *= 2.0;
            }
            let (end, others) = v.split_last_mut().unwrap();
            others[3] += *end;
            *end = others[0];
            for (i, pair) in v.chunks_mut(2).enumerate() {
                pair[0] *= (i + 1) as f64;
                if pair.len() == 2 { pair[1] = pair[0] - y; }
            }
            for pair in v.chunks_exact_mut(2) { pair.swap(0, 1); }
            let mut row = Row { cells: [x, y, 0.0, 1.0], total: 0.0 };
            let found = last(&mut row.cells).unwrap_or(0.0) + last(&mut []).unwrap_or(5.0);
            row.total += found;
            let mut stack = vec![x];
            stack.push(y);
            *stack.last_mut().unwrap() *= 3.0;
            if let Some(top) = stack.last_mut() { *top += x; }
            let sum: f64 = v.iter().enumerate().map(|(i, w)| (i + 1) as f64 * w).sum();
            sum + row.total * row.cells[3] + stack[1]
        }
    }
    patterns_on_mutable_references {
        struct Body { position: [f64; 2], speed: f64 }
        fn step(body: &mut Body, dt: f64) {
            let Body { position, speed } = body;
            let [a, b] = position;
            *a += *speed * dt;
            *b -= dt;
            *speed *= 0.5;
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut body = Body { position: [x, y], speed: x - y };
            step(&mut body, 0.5);
            step(&mut body, y);
            let mut v = [x, y, 2.0, 3.0];
            if let [first, .., end] = &mut v { *first += *end; *end *= y; }
            let [one, rest @ ..] = &mut v;
            *one *= 2.0;
            rest[0] += *one;
            rest[1..].fill(x);
            for &mut w in v.iter_mut() { body.speed += w; }
            let mut pairs = [(x, 1.0), (y, 2.0)];
            for (k, weight) in pairs.iter_mut() { *k *= *weight; *weight += 1.0; }
            for pair in &mut pairs { let (k, weight) = pair; *k += *weight; }
            if let Some((k, _)) = pairs.last_mut() { *k -= 1.0; }
            body.position[0] * v[0] + body.position[1] * v[1] + body.speed + v[3] + pairs[0].0 + pairs[1].0 * pairs[1].1
        }
    }
    aliases_of_mutable_references {
        struct Body { at: f64, speed: f64 }
        impl Body {
            fn step(&mut self, dt: f64) {
                let Self { at, speed } = self;
                *at += *speed * dt;
                *speed *= 0.5;
            }
        }
        fn twice(body: &mut Body) {
            let b = body;
            b.speed *= 2.0;
            let c = &mut *b;
            c.at += 1.0;
        }
        fn larger<'a>(one: &'a mut f64, n: &mut f64) -> f64 {
            let v = one;
            *v += *n;
            let before = *v;
            *v *= 2.0;
            before
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let mut body = Body { at: x, speed: y };
            body.step(0.5);
            twice(&mut body);
            let (mut a, mut b) = (x, 3.0);
            let before = larger(&mut a, &mut b);
            let mut rows = [[x, y], [1.0, 2.0]];
            for row in rows.iter_mut() { let [p, q] = row; core::mem::swap(p, q); }
            let total = { let one = &mut rows[1]; let other = one; other[0] += x; other[0] };
            body.at + body.speed * a + before * rows[0][0] + total * rows[1][0]
        }
    }
}

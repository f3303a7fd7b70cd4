//! Tests of arrays, lists and iterators.

use super::same;

same! {
    folds_keys_and_repetitions {
        pub fn f(x: f64, y: f64) -> f64 {
            let all = [x, y, x * y, 2.0];
            let product = all.iter().try_fold(1.0, |a, b| (*b > -2.0).then_some(a * b)).unwrap_or(-7.0);
            let mut left = all.iter();
            let sum = left.try_fold(0.0, |a, b| if *b > 0.0 { Some(a + b) } else { None });
            let rest = left.next().copied().unwrap_or_default();
            let checked: Result<f64, String> = all.iter().try_fold(x, |a, b| if a > b + 9.0 { Err(String::new()) } else { Ok(a - b) });
            let nearest = all.iter().copied().min_by_key(|v| (v * 2.0) as i32).unwrap_or(0.0);
            let farthest = all.iter().copied().max_by_key(|v| (v * 2.0) as i32).unwrap_or(0.0);
            let repeated: f64 = std::iter::repeat(x).zip(all).map(|(a, b)| a * b).sum();
            let taken: f64 = std::iter::repeat(y).take(3).sum();
            let seen: f64 = all.iter().inspect(|v| assert!(v.is_finite())).sum();
            let gone: f64 = all.get(7).copied().unwrap_or_default();
            let default = gone + sum.unwrap_or_default();
            product + 10.0 * rest + checked.unwrap_or(3.0) + 100.0 * nearest - 7.0 * farthest + repeated + taken + seen + default + x.midpoint(y)
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
    sums_of_empty_iterators {
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
    filtered_elements {
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
    elements_at_computed_indices {
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
    saturating_differences {
        fn before(values: &[f64], n: usize) -> f64 { values[n.saturating_sub(1)] }
        pub fn f(x: f64, y: f64) -> f64 {
            let values = [x, y, x * y, 1.0];
            let mut sums = [0.0; 4];
            for i in 0..values.len() {
                sums[i.saturating_sub(2)] += (i + 1) as f64 * before(&values, i) - values[(i + 1).saturating_sub(i)];
            }
            let last: usize = values.len().saturating_sub(5);
            let cell = (x.floor() as u8).saturating_sub(2) as f64 + (y.floor() as i32 as usize).saturating_sub(7) as f64;
            sums[0] + x * sums[1] + values[last] + if x >= 0.0 && y >= 0.0 { cell } else { 0.0 }
        }
    }
    lists_whose_length_depends_on_arguments {
        fn outliers(values: &[f64], limit: f64) -> Vec<f64> {
            let mut all = Vec::new();
            for v in values {
                if *v > limit { all.push(2.0 * v); } else if *v < -limit { all.push(-v); all.push(1.0); }
            }
            all
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let values = [x, y, x * y, x - y, 0.5];
            let mut all = outliers(&values, 1.0);
            let mean = if all.is_empty() { 0.0 } else { all.iter().sum::<f64>() / all.len() as f64 };
            let (first, last) = (all.first().copied().unwrap_or(-3.0), all.last().copied().unwrap_or(4.0));
            let second = all.get(1).copied().unwrap_or(0.25);
            let third = if all.len() > 2 { all[2] } else { 0.125 };
            if !all.is_empty() { all[0] *= 3.0; let end = all.len() - 1; all[end] += y; }
            let popped = all.pop().unwrap_or(8.0);
            all.extend([x].iter().filter(|v| **v > 0.0));
            all.sort_by(|a, b| a.total_cmp(b));
            let smallest = all.first().copied().unwrap_or(16.0);
            all.truncate(2);
            all.retain(|v| *v != 1.0);
            all.reverse();
            let mut positive: Vec<f64> = values.iter().copied().filter(|v| *v > 0.0).collect();
            positive.insert(0, y);
            let chosen = if x > y { values[..2].to_vec() } else { values[1..4].to_vec() };
            let mut queue = outliers(&values, 0.9);
            if queue.len() > 1 { let second = queue.remove(1); queue.insert(queue.len() - 1, 2.0 * second); }
            let mut depth = 0.0;
            for v in chosen.iter().chain(&queue) { depth = 0.5 * depth + v; }
            let counted = &values[..(x.abs() as usize).min(4)];
            let middle: f64 = values[1..=counted.len()].iter().sum();
            mean + middle + counted.iter().map(|v| v * v).sum::<f64>() + first * last + second + third + popped + smallest + all.iter().map(|v| v * v).sum::<f64>() + all.len() as f64
                + positive.iter().enumerate().map(|(i, v)| i as f64 * v).sum::<f64>() + depth + chosen.len() as f64
                + if all.contains(&2.0) { 100.0 } else { 0.0 } + outliers(&[x, y], 0.75).iter().rev().fold(0.0, |h, v| 0.5 * h + v)
        }
    }
    iterators_in_variables {
        pub fn f(x: f64, y: f64) -> f64 {
            let values = [x, y, 2.0, x + y, -1.0];
            let mut rest = values.iter();
            let first = rest.next().unwrap();
            let above = rest.find(|v| **v > 0.6).copied().unwrap_or(-7.0);
            let left: f64 = rest.clone().sum();
            let next = rest.next().copied().unwrap_or(0.125);
            let has = rest.any(|v| *v < 0.0);
            let mut pairs = values.chunks_exact(2);
            let mut cross = 0.0;
            while let Some(pair) = pairs.next() { cross += pair[0] * pair[1]; }
            let mut some = values.iter().copied().filter(|v| *v > y);
            let (a, b) = (some.next().unwrap_or(3.0), some.nth(1).unwrap_or(5.0));
            let weights = [1.0, 2.0, 4.0];
            let weighted: f64 = values.iter().filter(|v| **v < 1.0).zip(&weights).map(|(v, w)| v * w).sum();
            let weighed: f64 = weights.iter().zip(values.iter().filter(|v| **v < 1.0)).map(|(w, v)| w - v).sum();
            let both: f64 = values.iter().filter(|v| **v < 1.0).zip(values.iter().filter(|v| **v > y)).map(|(a, b)| a * b).sum();
            let (low, high): (Vec<f64>, Vec<f64>) = values.iter().partition(|v| **v < y);
            let skipped: f64 = values.iter().filter(|v| **v > -0.9).skip(1).take(2).sum();
            let fourth = values.iter().filter(|v| **v > -0.9).nth(3).copied().unwrap_or(9.0);
            let place = values.iter().filter(|v| **v > -0.9).position(|v| *v > 1.9).map_or(11.0, |p| p as f64);
            let all_low = values.iter().filter(|v| **v < 3.0).all(|v| *v < 1.0);
            let flat: f64 = values.iter().map(|v| (*v > 0.0).then_some(*v)).flatten().sum();
            first + above + left + next + if has { 50.0 } else { 0.0 } + cross + a * b + weighted + weighed
                + both + low.len() as f64 * 10.0 + high.iter().product::<f64>() + skipped + fourth + place
                + if all_low { 70.0 } else { 0.0 } + flat
        }
    }
    side_effects_of_searches {
        pub fn f(x: f64, y: f64) -> f64 {
            let v = [x, y, 2.0, -1.0];
            let mut seen = 0.0;
            let found = v.iter().find(|a| { seen += 1.0; **a > 1.0 }).copied().unwrap_or(9.0);
            let any = v.iter().any(|a| { seen += 10.0; *a < -0.5 });
            let all = v.iter().all(|a| { seen += 100.0; *a > -0.75 });
            let at = v.iter().position(|a| { seen += 1000.0; *a == 2.0 }).unwrap();
            let mut kept = v.to_vec();
            kept.retain(|a| { seen += 0.5; *a > y });
            let mut it = kept.iter();
            if x > 0.0 { it.next(); }
            for _ in 0..2 { if y > 0.0 { if let Some(a) = it.next() { seen += a; } } }
            let left: f64 = it.sum();
            let fm = v.iter().find_map(|a| { seen += 0.25; if *a > x { Some(*a) } else { None } }).unwrap_or(-3.0);
            let (low, high): (Vec<f64>, Vec<f64>) = v.iter().partition(|a| { seen += 0.125; **a < 0.6 });
            found + seen + left + at as f64 + fm + low.len() as f64 * high.iter().sum::<f64>() + if any { 5.0 } else { 0.0 } + if all { 7.0 } else { 0.0 }
        }
    }
    iterators_and_lists_as_arguments {
        fn two(it: &mut impl Iterator<Item = f64>) -> f64 { it.next().unwrap_or(1.0) - 2.0 * it.next().unwrap_or(2.0) }
        fn rest(it: impl Iterator<Item = f64>) -> f64 { it.fold(0.0, |s, v| 0.5 * s + v) }
        struct Holder { all: Vec<f64>, n: usize }
        impl Holder {
            fn add(&mut self, v: f64) { if v > 0.0 { self.all.push(v); } self.n += 1; }
            fn mean(&self) -> f64 { if self.all.is_empty() { return -1.0; } self.all.iter().sum::<f64>() / self.all.len() as f64 }
        }
        pub fn f(x: f64, y: f64) -> f64 {
            let v = [x, y, 1.5, -2.0, 0.5];
            let mut it = v.iter().copied().filter(|a| *a > -1.5);
            let a = two(&mut it);
            let b = rest(it);
            let mut h = Holder { all: vec![], n: 0 };
            for w in v { h.add(w - 0.4); }
            let mut other = Holder { all: h.all.clone(), n: 1 };
            if x > y { other.add(x); other.add(y); } else { other.add(-x); }
            let mut pair = if x > 1.0 { vec![1.0, y] } else { vec![x] };
            let n = pair.len();
            pair.push(3.0);
            let end = pair.len() - 1; pair[end] += y;
            let mut sorted = other.all.clone();
            sorted.sort_by(|a, b| b.partial_cmp(a).unwrap());
            let top = sorted.first().copied().unwrap_or(0.0) - sorted.last().copied().unwrap_or(0.0);
            let index = sorted.iter().position(|s| *s < 1.0).unwrap_or(sorted.len());
            a + b + h.mean() + other.mean() * other.n as f64 + n as f64 + pair.iter().sum::<f64>() + top + index as f64
        }
    }
    sorting_ignores_absent_elements {
        pub fn f(x: f64, y: f64) -> f64 {
            let mut logarithms = Vec::new();
            for v in [4.0, x, 2.0, y, 0.5] { if v > 0.0 { logarithms.push(f64::ln(v)); } }
            logarithms.sort_by(|a, b| a.partial_cmp(b).unwrap());
            logarithms.iter().fold(0.0, |sum, v| 0.5 * sum + v)
        }
    }
}

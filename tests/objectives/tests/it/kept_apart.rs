//! Loops that remain loops, in which unselected parts must not contribute: paths around a loop, absent values, loops
//! that would not terminate on a path not taken, and states of all kinds.

#[aim::differentiate]
mod functions {
    use aim::glam::{DAffine3, DMat4, DVec3};

    #[differentiate(wrt(x, y))]
    pub(super) fn power(x: f64, y: f64, s: &[f64]) -> f64 {
        if x > 0.0 {
            let mut r = x.powf(y);
            for v in s {
                r = r * 0.5 + v * y;
            }
            r
        } else {
            x * y
        }
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn mean_of_none(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut last = s.iter().map(|v| v * x).sum::<f64>() / s.len() as f64;
        for v in s {
            last = last * 0.5 + v * y;
        }
        if s.is_empty() { x } else { last }
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn returned_before(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut r = x;
        for v in s {
            if r <= 1.0 {
                return r * y;
            }
            r = r.acosh() * v * 4.0;
        }
        r
    }

    /// Terminates only for x < 0.
    fn falls(x: f64) -> f64 {
        let mut z = x;
        while z > -5.0 {
            z *= 1.5;
        }
        z + x
    }

    fn below(x: f64) -> Option<f64> {
        if x >= 0.0 { None } else { Some(x) }
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn returned_inside(x: f64, y: f64, s: &[f64]) -> f64 {
        for k in 1..3 {
            if x * f64::from(k) >= 0.0 {
                return y;
            }
        }
        falls(x) * y + s[0]
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn left_inside(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut sum = y * s[0];
        for k in 0..2 {
            if x >= 0.0 && k == 0 {
                break;
            }
            sum += falls(x);
        }
        sum
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn returned_in_a_kept_one(x: f64, y: f64, s: &[f64]) -> f64 {
        if y < 100.0 {
            for v in s {
                if x >= 0.0 {
                    return y * v;
                }
            }
        }
        falls(x)
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn nothing_inside(x: f64, y: f64, s: &[f64]) -> Option<f64> {
        let mut r = y * s[0];
        if y < 100.0 {
            r *= below(x)?;
        }
        Some(r + falls(x))
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn none_in_a_round(x: f64, y: f64, s: &[f64]) -> Option<f64> {
        let mut sum = 0.0;
        for v in s {
            if *v < x {
                return None;
            }
            sum += v * x * y;
        }
        Some(sum)
    }

    /// Loops over parts of a slice, and searches that end early.
    #[differentiate(wrt(x, y))]
    pub(super) fn parts(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut k = 0.0;
        let any = s.iter().any(|v| {
            k += x;
            *v > y
        });
        let part = s.iter().take(3).skip(1).map(|v| x * v + y).sum::<f64>();
        let turned = s.iter().take(4).rev().step_by(2).fold(0.0, |t, v| t * x + v);
        part + turned + if any { k } else { y }
    }

    /// Borrowed variables, one without a value, and a counter that grows fast.
    #[differentiate(wrt(x, y))]
    pub(super) fn lent(x: f64, y: f64, s: &[f64]) -> f64 {
        fn gather(sum: &mut f64, s: &[f64], by: f64) {
            for v in s {
                *sum += v * by;
            }
        }
        let mut sum = x;
        gather(&mut sum, s, y);
        let mut k = 0.0;
        let mut add = |c: f64| {
            for w in s {
                k += c * w * x;
            }
        };
        add(2.0);
        add(y);
        let (mut step, mut count) = (0.0, 1);
        let rest;
        while count < s.len() * 300 {
            count *= 2;
            step = 0.5 * step + y;
        }
        let mut halved = x;
        loop {
            let half = 0.5 * halved;
            halved -= half;
            if half.abs() < 1e-3 {
                rest = half * 1e3;
                break;
            }
        }
        sum + k + step + rest
    }

    #[derive(Clone, Copy)]
    enum Mode {
        Off,
        On(f64),
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn states(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut mode = Mode::Off;
        let mut r = x;
        let (mut m, mut q) = (DMat4::IDENTITY, DAffine3::IDENTITY);
        for v in s {
            mode = match mode {
                Mode::Off => Mode::On(v * x),
                Mode::On(t) if t > y => Mode::Off,
                Mode::On(t) => Mode::On(t * 0.5 + r),
            };
            r += match mode {
                Mode::On(t) => t * t,
                Mode::Off => 0.25,
            };
            m *= DMat4::from_rotation_z(x * v);
            q *= DAffine3::from_axis_angle(DVec3::X, y * v);
        }
        r + m.transform_point3(DVec3::X).y + q.transform_point3(DVec3::Y).z
    }
}

/// States that are empty at first and are filled over more than one iteration.
#[aim::differentiate]
mod filled {
    #[derive(Clone, Copy)]
    enum Phase {
        Idle,
        Rising(f64),
        Falling(f64),
    }

    impl Phase {
        fn nudge(&mut self, by: f64) -> f64 {
            match self {
                Self::Idle => return 0.0,
                Self::Rising(value) => *value += by,
                Self::Falling(value) => *value *= by,
            }
            0.5
        }
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn second_differences(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut last, mut older, mut sum) = (None, None, y);
        for &v in s {
            if let (Some(p), Some(q)) = (last, older) {
                let bend: f64 = v - 2.0 * p + q;
                sum += x * bend * bend;
            }
            older = last;
            last = Some(v * x);
        }
        sum + older.unwrap_or(y)
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn three_before(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut first, mut second, mut third, mut sum) = (None, None, None, x * y);
        for v in s {
            if let (Some(p), Some(q), Some(r)) = (first, second, third) {
                let twist: f64 = v - 3.0 * p + 3.0 * q - r;
                sum += y * twist * twist;
            }
            third = second;
            second = first;
            first = Some(*v);
        }
        sum
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn mapped(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut last, mut older, mut doubled, mut sum) = (None, None, None, x);
        for v in s {
            let twice = older.map(|v: f64| 2.0 * v);
            sum += x + twice.unwrap_or(y) + f64::from(u8::from(older.is_some_and(|v| v > x)));
            doubled = older.as_ref().map(|v| v * y);
            older = last.filter(|v| *v > -1.0);
            last = Some(v * y);
        }
        sum + doubled.unwrap_or(0.5 * x)
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn never_filled(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut none, mut sum) = (None::<f64>, x);
        for v in s {
            none = none.map(|h| 2.0 * h).filter(|h| *h > 0.0);
            sum += v * x * y;
        }
        sum + none.unwrap_or(y)
    }

    /// The first iteration fills the option.
    #[differentiate(wrt(x, y))]
    pub(super) fn unwrapped(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut sum, mut last) = (y, None);
        for (i, v) in s.iter().enumerate() {
            if i > 0 {
                let before: f64 = last.unwrap();
                sum += before * x;
            }
            last = Some(*v * y);
        }
        sum
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn unwrapped_in_a_branch(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut last = None;
        for (i, v) in s.iter().enumerate() {
            if i == 0 {
                last = Some(v * x);
            } else {
                last = Some(last.unwrap() * y + v);
            }
        }
        last.unwrap_or(x)
    }

    fn taken(option: Option<f64>) -> f64 {
        option.unwrap()
    }

    /// The called function panics unless the option is known to be filled.
    #[differentiate(wrt(x, y))]
    pub(super) fn unwrapped_elsewhere(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut sum, mut last) = (x, None);
        for (i, v) in s.iter().enumerate() {
            if i > 0 {
                sum += taken(last);
            }
            last = Some(*v * y);
        }
        sum
    }

    fn twice_sine(v: f64) -> f64 {
        (2.0 * v).sin()
    }

    fn through(v: f64) -> f64 {
        twice_sine(v)
    }

    /// A loop that is first tried unrolled.
    #[differentiate(wrt(x, y))]
    pub(super) fn counted_by_an_option(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut sum, mut count, mut some) = (x, 0, Some(y));
        while let Some(value) = some {
            count += 1;
            if count > s.len() {
                break;
            }
            sum += through(value * x);
            some = Some(y);
        }
        sum
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn beside_an_option(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut b, mut c) = ((2.0, None), (3.0, None));
        for v in s {
            b = c;
            c = (1.5 * y, Some(*v));
        }
        b.0 * x + b.1.unwrap_or(y)
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn one_after_the_other(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut phase = Phase::Idle;
        for v in s {
            phase = match phase {
                Phase::Falling(_) => Phase::Idle,
                Phase::Rising(top) => Phase::Falling(top * v),
                Phase::Idle => Phase::Rising(y),
            };
        }
        if let Phase::Falling(value) = phase {
            value
        } else if let Phase::Rising(value) = phase {
            10.0 * value
        } else {
            7.0 * x
        }
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn in_turn(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut phase = Phase::Rising(x);
        for v in s {
            phase = Phase::Rising(
                v * match phase {
                    Phase::Idle => 0.7,
                    Phase::Rising(value) => value * y,
                    Phase::Falling(value) => value.tanh(),
                },
            );
        }
        let (Phase::Rising(value) | Phase::Falling(value)) = phase else { return 0.0 };
        value
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn emptied(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut phase = Phase::Falling(x);
        for v in s {
            phase = match phase {
                Phase::Falling(value) if value > 0.0 => Phase::Idle,
                Phase::Falling(value) => Phase::Falling(value + v),
                Phase::Rising(value) => Phase::Rising(value),
                Phase::Idle => Phase::Rising(y),
            };
        }
        match phase {
            Phase::Idle => 1.0,
            Phase::Rising(value) => value,
            Phase::Falling(value) => value * value,
        }
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn nudged(x: f64, y: f64, s: &[f64]) -> f64 {
        let (mut phase, mut sum) = (Phase::Rising(y), 0.0);
        for v in s {
            sum += phase.nudge(*v);
        }
        sum * x + phase.nudge(y)
    }

    fn root(x: f64) -> Option<f64> {
        if x > 0.0 { Some(x.sqrt()) } else { None }
    }

    /// An absent value would be NaN.
    #[differentiate(wrt(x, y))]
    pub(super) fn of_a_root(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut length = root(x);
        for v in s {
            length = length.map(|length| length * y + v);
        }
        length.map_or(x * x, |length| length * y).sin()
    }

    #[derive(Clone, Copy)]
    enum Path {
        Straight(f64),
        Bent { radius: f64, height: f64 },
    }

    /// The fields of other variants of an enum would be NaN.
    #[differentiate(wrt(x, y))]
    pub(super) fn of_another_variant(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut path = if x > y { Path::Bent { radius: (x - y).ln(), height: y } } else { Path::Straight(y) };
        for v in s {
            path = match path {
                Path::Straight(length) => Path::Straight(length * v),
                Path::Bent { radius, height } => Path::Bent { radius: height.cos(), height: radius.sin() * v },
            };
        }
        let area = match path {
            Path::Straight(length) => length * x,
            Path::Bent { radius, height } => radius * height * x,
        };
        area.cos()
    }

    fn first_root(x: f64, s: &[f64]) -> Option<f64> {
        for v in s {
            let root = (v * x - 0.5).sqrt();
            if root > 0.0 {
                return Some(root);
            }
        }
        None
    }

    /// Candidates for a loop's result that are not returned would be NaN.
    #[differentiate(wrt(x, y))]
    pub(super) fn left_with_a_root(x: f64, y: f64, s: &[f64]) -> f64 {
        first_root(x, s).map_or(x, |root| root * y).sin()
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn now_and_then(x: f64, y: f64, s: &[f64]) -> f64 {
        let mut kept = [None; 2];
        for v in s {
            if *v > 0.0 {
                kept[0] = Some(v * y);
            } else if let Some(first) = kept[0] {
                kept[1] = Some(first);
            }
        }
        kept[1].unwrap_or(x)
    }
}

type Gradient<R> = fn(f64, f64, &[f64]) -> R;

/// Compares a gradient with differences, for slices of several lengths.
fn agrees(name: &str, f: Gradient<f64>, gradient: Gradient<(f64, (f64, f64))>, least: usize) {
    let s = [0.9, 1.2, -1.3, 0.25, 0.7, -0.4];
    for n in least..=s.len() {
        let s = &s[..n];
        for x in [-1.7, -0.71, -0.2, 0.33, 0.84, 1.9, 3.1] {
            for y in [-0.6, 0.37, 1.05] {
                let (value, (by_x, by_y)) = gradient(x, y, s);
                let h = 1e-6;
                let slope_x = (f(x + h, y, s) - f(x - h, y, s)) / (2.0 * h);
                let slope_y = (f(x, y + h, s) - f(x, y - h, s)) / (2.0 * h);
                for (found, expected) in [(value, f(x, y, s)), (by_x, slope_x), (by_y, slope_y)] {
                    let is_near = (found - expected).abs() < 1e-6 * (1.0 + expected.abs());
                    assert!(is_near, "{name} at {x}, {y}, {s:?}: {found}, expected {expected}");
                }
            }
        }
    }
}

#[test]
fn options_and_enums_that_are_filled_round_by_round() {
    agrees("second differences", filled::second_differences, filled::second_differences_gradient, 0);
    agrees("three before", filled::three_before, filled::three_before_gradient, 0);
    agrees("mapped", filled::mapped, filled::mapped_gradient, 0);
    agrees("never filled", filled::never_filled, filled::never_filled_gradient, 0);
    agrees("unwrapped", filled::unwrapped, filled::unwrapped_gradient, 0);
    agrees("unwrapped in a branch", filled::unwrapped_in_a_branch, filled::unwrapped_in_a_branch_gradient, 0);
    agrees("unwrapped elsewhere", filled::unwrapped_elsewhere, filled::unwrapped_elsewhere_gradient, 0);
    agrees("counted by an option", filled::counted_by_an_option, filled::counted_by_an_option_gradient, 0);
    agrees("beside an option", filled::beside_an_option, filled::beside_an_option_gradient, 0);
    agrees("one after the other", filled::one_after_the_other, filled::one_after_the_other_gradient, 0);
    agrees("in turn", filled::in_turn, filled::in_turn_gradient, 0);
    agrees("emptied", filled::emptied, filled::emptied_gradient, 0);
    agrees("nudged", filled::nudged, filled::nudged_gradient, 0);
    agrees("now and then", filled::now_and_then, filled::now_and_then_gradient, 0);
    agrees("of a root", filled::of_a_root, filled::of_a_root_gradient, 0);
    agrees("of another variant", filled::of_another_variant, filled::of_another_variant_gradient, 0);
    agrees("left with a root", filled::left_with_a_root, filled::left_with_a_root_gradient, 0);
}

#[test]
fn what_is_not_chosen_does_not_count() {
    agrees("power", functions::power, functions::power_gradient, 0);
    agrees("mean", functions::mean_of_none, functions::mean_of_none_gradient, 0);
    agrees("returned before", functions::returned_before, functions::returned_before_gradient, 0);
}

#[test]
fn loops_end_where_control_does_not_come() {
    agrees("returned inside", functions::returned_inside, functions::returned_inside_gradient, 1);
    agrees("left inside", functions::left_inside, functions::left_inside_gradient, 1);
    agrees("returned in a loop", functions::returned_in_a_kept_one, functions::returned_in_a_kept_one_gradient, 1);
    let value = |x, y, s: &[f64]| functions::nothing_inside(x, y, s).unwrap_or(0.0);
    let gradient = |x, y, s: &[f64]| functions::nothing_inside_gradient(x, y, s).unwrap_or_default();
    agrees("nothing inside", value, gradient, 1);
    let value = |x, y, s: &[f64]| functions::none_in_a_round(x, y, s).unwrap_or(0.0);
    let gradient = |x, y, s: &[f64]| functions::none_in_a_round_gradient(x, y, s).unwrap_or_default();
    agrees("none in a round", value, gradient, 0);
}

#[test]
fn variables_of_all_kinds() {
    agrees("parts", functions::parts, functions::parts_gradient, 0);
    agrees("lent", functions::lent, functions::lent_gradient, 0);
    agrees("states", functions::states, functions::states_gradient, 0);
}

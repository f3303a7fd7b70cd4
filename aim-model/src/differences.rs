//! The test that `#[differentiate(check = true)]` writes: derivatives against central differences at random points.

use crate::Scalar;

/// What the next numbers of an argument are drawn as.
#[derive(Clone, Copy, Debug)]
pub enum Draw {
    /// A number.
    Number,
    /// A whole number from 0, below this.
    Below(u32),
    /// 1 or −1, for true and false.
    Truth,
    /// Four numbers of length 1.
    Quaternion,
    /// 0: a component of a step on a manifold.
    Zero,
    /// A rotation's nine numbers and a translation's three.
    Rigid,
}

/// How far apart the points of a difference are, and what counts as agreement, relative to the numbers compared and 1.
struct Precision {
    step: f64,
    tolerance: f64,
    /// Beyond this slope rounding decides: what is there is not judged.
    steepest: f64,
}

const SINGLE: Precision = Precision { step: 1.0 / 64.0, tolerance: 1e-2, steepest: 1e4 };
const DOUBLE: Precision = Precision { step: 1.0 / 1024.0, tolerance: 1e-6, steepest: 1e9 };

const POINTS: usize = 256;

/// Compares the derivatives of a function of `N` numbers with `R` results, by the `V` numbers at `variables`: `derivatives`
/// gives for each variable those of all results. A point counts where the differences of two steps agree: where the function
/// is defined around it and no kink is near; and where it is not so steep that rounding decides.
///
/// # Panics
/// Where they differ, and where no point counts.
pub fn agree<const N: usize, const V: usize, const R: usize>(
    name: &str,
    (draws, variables, single): (&[Draw], &[usize; V], bool),
    value: impl Fn(&[f64; N]) -> [f64; R],
    derivatives: impl Fn(&[f64; N]) -> [[f64; R]; V],
) {
    let Precision { step, tolerance, steepest } = if single { SINGLE } else { DOUBLE };
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut judged = 0_usize;
    for round in 0..POINTS {
        // Every other point has no negative numbers: not all functions take them.
        let point: [f64; N] = random.point(draws, if round % 2 == 0 { -2.0 } else { 0.125 });
        let (here, found) = (value(&point), derivatives(&point));
        for (&variable, found) in variables.iter().zip(&found) {
            let slopes = |step: f64| -> [f64; R] {
                let [up, down] = [step, -step].map(|step| {
                    let mut moved = point;
                    moved[variable] += step;
                    value(&moved)
                });
                core::array::from_fn(|k| (up[k] - down[k]) / (2.0 * step))
            };
            let (wide, narrow) = (slopes(step), slopes(0.5 * step));
            for k in 0..R {
                let scale = tolerance * (1.0 + here[k].abs() + narrow[k].abs());
                if (wide[k] - narrow[k]).abs() <= 0.25 * scale && narrow[k].abs() <= steepest {
                    judged += 1;
                    let expected = narrow[k] + (narrow[k] - wide[k]) / 3.0;
                    assert!(
                        (found[k] - expected).abs() <= scale,
                        "{name}, component {k}, by number {variable} of {point:?}: {}, by differences {expected}",
                        found[k],
                    );
                }
            }
        }
    }
    assert!(
        judged > 0,
        "{name}: at none of {POINTS} random points does the function have a slope; test it at points of its own"
    );
}

/// The generator of Marsaglia.
struct Random(u64);

impl Random {
    /// A number from 0 to 1.
    #[allow(clippy::cast_precision_loss, reason = "the upper bits are what is wanted")]
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point<const N: usize>(&mut self, draws: &[Draw], least: f64) -> [f64; N] {
        let mut point = [0.0; N];
        let mut rest = point.iter_mut();
        for draw in draws {
            let (numbers, count) = self.drawn(*draw, least);
            numbers[..count].iter().zip(&mut rest).for_each(|(number, place)| *place = *number);
        }
        point
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers are rounded down")]
    fn drawn(&mut self, draw: Draw, least: f64) -> ([f64; 12], usize) {
        let mut numbers = [0.0; 12];
        let count = match draw {
            Draw::Number => {
                numbers[0] = least + (2.0 - least) * self.next();
                1
            }
            Draw::Zero => 1,
            Draw::Below(end) => {
                numbers[0] = f64::from((f64::from(end) * self.next()) as u32);
                1
            }
            Draw::Truth => {
                numbers[0] = if self.next() < 0.5 { 1.0 } else { -1.0 };
                1
            }
            Draw::Quaternion => {
                numbers[..4].copy_from_slice(&self.unit());
                4
            }
            Draw::Rigid => {
                let [x, y, z, w] = self.unit();
                let columns = [
                    [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
                    [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
                    [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
                ];
                numbers[..9].copy_from_slice(columns.as_flattened());
                numbers[9..].iter_mut().for_each(|number| *number = 4.0 * self.next() - 2.0);
                12
            }
        };
        (numbers, count)
    }

    /// Four numbers of length 1.
    fn unit(&mut self) -> [f64; 4] {
        loop {
            let numbers = [0; 4].map(|_| 2.0 * self.next() - 1.0);
            let square: f64 = numbers.iter().map(|x| x * x).sum();
            if (0.01..1.0).contains(&square) {
                return numbers.map(|x| x / Scalar::sqrt(square));
            }
        }
    }
}

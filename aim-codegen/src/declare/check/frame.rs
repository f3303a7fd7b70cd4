//! Geometry of bone axes: orthogonalisation, completion, and the nearest proper frame. Independent of declarations.

use crate::Frame;

pub(super) type Vector = [f64; 3];

/// Sine of the largest deviation from a right angle that is accepted as rounding: half a degree.
pub(super) const SQUARE_SIN: f64 = 0.008_726_535_498_373_935;

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn scale(factor: f64, a: Vector) -> Vector {
    // Adding zero turns -0 into 0, which keeps cardinal frames free of signed zeros.
    a.map(|x| factor * x + 0.0)
}

pub(super) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// Normalises `a`; returns a zero vector unchanged.
pub(super) fn unit(a: Vector) -> Vector {
    let length = length(a);
    if length > 0.0 { a.map(|x| x / length + 0.0) } else { a }
}

/// Removes from `a` its component along the unit vector `b`, and normalises.
fn squared_to(a: Vector, b: Vector) -> Vector {
    let along = dot(a, b);
    unit([a[0] - along * b[0], a[1] - along * b[1], a[2] - along * b[2]])
}

/// Returns the frame with exactly this forward and the nearest orthogonal up. `hand` is 1 for a right-handed triple, -1
/// for a left-handed one.
pub(super) fn square(up: Vector, forward: Vector, hand: f64) -> Frame {
    let up = squared_to(up, forward);
    Frame { up, forward, left: unit(scale(hand, cross(up, forward))) }
}

/// Completes two or three directions to a frame. `None` if fewer than two are given; they must not be parallel.
pub(super) fn complete(up: Option<Vector>, forward: Option<Vector>, left: Option<Vector>, hand: f64) -> Option<Frame> {
    let third = |a, b| unit(scale(hand, cross(a, b)));
    match (up, forward, left) {
        (Some(up), Some(forward), _) => Some(square(up, forward, hand)),
        (None, Some(forward), Some(left)) => Some(square(third(forward, left), forward, hand)),
        (Some(up), None, Some(left)) => Some(square(up, third(left, up), hand)),
        _ => None,
    }
}

/// Returns the orthogonal frame nearest to a skewed one: the orthogonal factor of its polar decomposition, by Newton
/// iteration.
///
/// A triple of the opposite handedness has its left negated first, so that the result is proper.
pub(super) fn nearest(up: Option<Vector>, forward: Option<Vector>, left: Option<Vector>, hand: f64) -> Option<Frame> {
    let start = complete(up, forward, left, hand)?;
    let mut rows = [up.unwrap_or(start.up), forward.unwrap_or(start.forward), left.unwrap_or(start.left)];
    if dot(cross(rows[0], rows[1]), rows[2]) * hand < 0.0 {
        rows[2] = scale(-1.0, rows[2]);
    }
    for _ in 0..24 {
        let [a, b, c] = rows;
        let volume = dot(cross(a, b), c);
        if volume.abs() < 1e-6 {
            // Nearly flat: the nearest frame is ill-conditioned. Keep forward instead.
            return Some(start);
        }
        let inverse = [cross(b, c), cross(c, a), cross(a, b)];
        for (row, other) in rows.iter_mut().zip(inverse) {
            for (x, y) in row.iter_mut().zip(other) {
                *x = 0.5 * (*x + y / volume);
            }
        }
    }
    Some(Frame { up: rows[0], forward: rows[1], left: rows[2] })
}

const LETTERS: [&str; 3] = ["X", "Y", "Z"];

/// Returns `+X` … `-Z` if the direction is a signed axis.
pub(super) fn cardinal(a: Vector) -> Option<String> {
    let axis = a.iter().position(|x| x.abs() > 1.0 - 1e-9)?;
    Some(format!("{}{}", if a[axis] < 0.0 { '-' } else { '+' }, LETTERS[axis]))
}

/// Returns the direction of an axis letter.
pub(super) fn axis(letter: &str, negative: bool) -> Option<Vector> {
    let axis = LETTERS.iter().position(|known| *known == letter)?;
    let mut direction = [0.0; 3];
    direction[axis] = if negative { -1.0 } else { 1.0 };
    Some(direction)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_proper(frame: &Frame, hand: f64) {
        for axis in [frame.up, frame.forward, frame.left] {
            assert!((length(axis) - 1.0).abs() < 1e-12, "{frame:?}");
        }
        assert!(dot(frame.up, frame.forward).abs() < 1e-12, "{frame:?}");
        let left = scale(hand, cross(frame.up, frame.forward));
        assert!((0..3).all(|i| (left[i] - frame.left[i]).abs() < 1e-12), "{frame:?}");
    }

    #[test]
    fn any_two_cardinal_axes_give_the_same_exact_third() {
        for hand in [1.0, -1.0] {
            for up in ["X", "Y", "Z"] {
                for forward in ["X", "Y", "Z"].into_iter().filter(|letter| *letter != up) {
                    for signs in 0..4 {
                        let up = axis(up, signs & 1 == 1);
                        let forward = axis(forward, signs & 2 == 2);
                        let frame = complete(up, forward, None, hand).expect("two axes");
                        assert_proper(&frame, hand);
                        assert!(cardinal(frame.left).is_some());
                        assert_eq!(complete(None, forward, Some(frame.left), hand), Some(frame));
                        assert_eq!(complete(up, None, Some(frame.left), hand), Some(frame));
                        assert!(
                            [frame.up, frame.forward, frame.left]
                                .concat()
                                .iter()
                                .all(|x| x.to_bits() != (-0.0f64).to_bits())
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn the_nearest_frame_is_proper_and_moves_all_axes_alike() {
        let up = unit([0.3, 1.0, 0.0]);
        let forward = [0.0, 0.0, 1.0];
        let left = unit([1.0, 0.1, 0.2]);
        for hand in [1.0, -1.0] {
            assert_proper(&nearest(Some(up), Some(forward), Some(left), hand).expect("a frame"), hand);
        }
        let tilted = unit([0.0, 1.0, 0.5]);
        let frame = nearest(Some(tilted), Some(forward), None, 1.0).expect("a frame");
        assert!((dot(frame.up, tilted) - dot(frame.forward, forward)).abs() < 1e-12);
    }
}

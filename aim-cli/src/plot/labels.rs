//! Placement of labels on contour lines: on straight stretches, clear of everything else.

use super::key::distance;

/// Place of a label.
pub(super) struct Place {
    pub(super) at: [f64; 2],
    /// Rotation, degrees clockwise, such that the text is never upside down.
    pub(super) turned: f64,
}

/// Half the length of the line that a label covers.
const HALF: f64 = 19.0;
/// Smallest distance of a label from anything else.
const CLEAR: f64 = 22.0;
/// Distance beyond which more clearance is no better.
const FAR: f64 = 90.0;

/// Area for labels, and obstacles in it.
pub(super) struct Ground {
    /// Left, top, right and bottom of the area in which labels are placed.
    within: [f64; 4],
    obstacles: Vec<[f64; 2]>,
}

impl Ground {
    /// Creates the area inside a rectangle, given by left, top, width and height.
    pub(super) fn new([left, top, width, height]: [f64; 4]) -> Self {
        const BORDER: f64 = 24.0;
        let within = [left + BORDER, top + BORDER, left + width - BORDER, top + height - BORDER];
        Self { within, obstacles: Vec::new() }
    }

    /// Adds a line that labels keep clear of.
    pub(super) fn keep_clear_of(&mut self, line: &[[f64; 2]]) {
        self.obstacles.extend(line);
        for pair in line.windows(2) {
            // Points between the ends, at most 6 units apart.
            let pieces = (distance(pair[0], pair[1]) / 6.0).ceil().clamp(1.0, 1e4);
            for piece in (1..10_000_u16).map(f64::from).take_while(|piece| *piece < pieces) {
                let part = piece / pieces;
                self.obstacles.push([0, 1].map(|k| pair[0][k] + part * (pair[1][k] - pair[0][k])));
            }
        }
    }

    /// Returns the best place on these closed lines, which becomes an obstacle. `None` if no place is clear enough.
    pub(super) fn place(&mut self, rings: &[Vec<[f64; 2]>]) -> Option<Place> {
        let mut best: Option<(f64, Place)> = None;
        for ring in rings {
            for k in 0..ring.len() {
                let Some(place) = self.candidate(ring, k) else { continue };
                let clear = self.obstacles.iter().map(|o| distance(*o, place.at)).fold(FAR, f64::min);
                // Flat labels are easier to read.
                let score = clear - 0.15 * place.turned.abs();
                if clear >= CLEAR && best.as_ref().is_none_or(|(most, _)| score > *most) {
                    best = Some((score, place));
                }
            }
        }
        let (_, place) = best?;
        self.obstacles.push(place.at);
        Some(place)
    }

    fn candidate(&self, ring: &[[f64; 2]], k: usize) -> Option<Place> {
        let at = ring[k];
        let [left, top, right, bottom] = self.within;
        if !(left..right).contains(&at[0]) || !(top..bottom).contains(&at[1]) {
            return None;
        }
        let ahead = walked(ring.iter().cycle().skip(k).take(ring.len()))?;
        let back = walked(ring.iter().rev().cycle().skip(ring.len() - 1 - k).take(ring.len()))?;
        // Straight enough for a label: the chord is hardly shorter than the line.
        if distance(ahead, back) < 0.96 * 2.0 * HALF {
            return None;
        }
        let turned = (ahead[1] - back[1]).atan2(ahead[0] - back[0]).to_degrees();
        let turned = if turned > 90.0 {
            turned - 180.0
        } else if turned <= -90.0 {
            turned + 180.0
        } else {
            turned
        };
        Some(Place { at, turned })
    }
}

/// Returns the point at the distance [`HALF`] along a line; `None` if the line is shorter.
fn walked<'a>(mut line: impl Iterator<Item = &'a [f64; 2]>) -> Option<[f64; 2]> {
    let mut at = *line.next()?;
    let mut left = HALF;
    for next in line {
        let step = distance(at, *next);
        if step >= left {
            return Some([0, 1].map(|k| at[k] + left / step * (next[k] - at[k])));
        }
        left -= step;
        at = *next;
    }
    None
}

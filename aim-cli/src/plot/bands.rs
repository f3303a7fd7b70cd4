//! The bands of a plot: its contour levels and colours.

use colorous::VIRIDIS;

/// Even bands of the angle off the target, degrees; nearer bands are lighter.
pub(super) struct Bands {
    step: f64,
    first: f64,
    last: f64,
}

/// Maximum number of bands.
const MOST: f64 = 9.0;

impl Bands {
    /// Creates the bands that cover the aims from `least` to `most`.
    pub(super) fn over(least: f64, most: f64) -> Self {
        let (near, far) = (off(most), off(least));
        let fits = |step: &f64| (far / step).ceil() - (near / step).floor() <= MOST;
        let step = [1.0, 2.0, 5.0, 10.0, 15.0].into_iter().find(fits).unwrap_or(20.0);
        let first = (near / step).floor() * step;
        Self { step, first, last: ((far / step).ceil() * step).max(first + step) }
    }

    /// Returns the borders of the bands, degrees off the target, nearest first.
    pub(super) fn edges(&self) -> Vec<f64> {
        let edge = |k: u8| self.first + f64::from(k) * self.step;
        (0..=u8::MAX).map(edge).take_while(|edge| *edge < self.last + self.step / 2.0).collect()
    }

    /// Returns the contour levels, degrees off the target, furthest first: the order of painting.
    pub(super) fn levels(&self) -> Vec<f64> {
        let edges = self.edges();
        edges[1..edges.len() - 1].iter().rev().copied().collect()
    }

    /// Returns the colour of the band that begins at this angle off the target, degrees.
    pub(super) fn beginning_at(&self, off: f64) -> String {
        self.colour(off + self.step / 2.0)
    }

    /// Returns the colour for an angle off the target, degrees.
    pub(super) fn colour(&self, off: f64) -> String {
        format!("#{:x}", VIRIDIS.eval_continuous(self.lightness(off)))
    }

    /// Returns the lightness for an angle off the target, degrees: from 0 (dark, furthest) to 1 (light, nearest).
    pub(super) fn lightness(&self, off: f64) -> f64 {
        ((self.last - off) / (self.last - self.first)).clamp(0.0, 1.0)
    }
}

/// Returns the angle off the target at this aim, degrees.
pub(super) fn off(aim: f64) -> f64 {
    aim.clamp(-1.0, 1.0).acos().to_degrees()
}

/// Returns the aim at this angle off the target, degrees.
pub(super) fn aim(off: f64) -> f64 {
    off.to_radians().cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_cover_what_is_drawn_in_round_steps() {
        for (near, far) in [(0.0, 78.0), (0.4, 3.2), (12.0, 179.9), (0.0, 180.0), (44.0, 44.5), (30.0, 30.0)] {
            let bands = Bands::over(aim(far), aim(near));
            let edges = bands.edges();
            assert!(edges[0] <= near + 1e-6 && edges[edges.len() - 1] >= far - 1e-6, "{near}…{far}: {edges:?}");
            assert!(edges.len() <= 11 && edges.windows(2).all(|pair| pair[1] > pair[0]), "{edges:?}");
            assert!(edges.iter().all(|edge| edge.fract() == 0.0), "{edges:?}");
            assert_eq!(bands.levels().len(), edges.len() - 2);
            assert!(bands.lightness(edges[0]) == 1.0 && bands.lightness(far) < 0.6);
        }
    }
}

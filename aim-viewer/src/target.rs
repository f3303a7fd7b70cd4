//! The target, which is still or moves on a path around the character.

use aim_runtime::glam::Vec3;

/// The path of a target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Path {
    /// No movement.
    #[default]
    Still,
    /// A circle around the character.
    Orbit,
    /// A figure of eight on its side, in front of the character.
    Eight,
    /// An irregular path in front of the character, which repeats only after hours.
    Noise,
}

impl Path {
    pub(crate) const ALL: [Self; 4] = [Self::Still, Self::Orbit, Self::Eight, Self::Noise];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Still => "still",
            Self::Orbit => "orbit",
            Self::Eight => "figure of eight",
            Self::Noise => "noise",
        }
    }
}

/// The coordinate system of paths, relative to the character.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room {
    /// Position of the effector in the bind pose, world space.
    pub(crate) centre: Vec3,
    /// Up, forward and left of the character: unit vectors, world space.
    pub(crate) directions: [Vec3; 3],
    /// Length that corresponds to 1 m if the character is 1.7 m tall.
    pub(crate) metre: f32,
}

impl Room {
    /// Returns the point at these distances to the left, up and in front, metres of a 1.7 m character.
    pub(crate) fn point(&self, left: f32, up: f32, forward: f32) -> Vec3 {
        let [u, f, l] = self.directions;
        self.centre + (l * left + u * up + f * forward) * self.metre
    }

    /// Returns a point's distances to the left, up and in front, metres of a 1.7 m character: the inverse of
    /// [`point`](Self::point).
    pub(crate) fn place(&self, point: Vec3) -> [f32; 3] {
        let [u, f, l] = self.directions;
        [l, u, f].map(|axis| (point - self.centre).dot(axis) / self.metre)
    }
}

/// A target that moves on a path or by hand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    /// Position of a still target, world space.
    pub(crate) place: Vec3,
    pub(crate) path: Path,
    /// Time on the path, seconds.
    pub(crate) time: f32,
}

/// Period of the orbit, seconds.
const ORBIT: f32 = 8.0;
/// Period of the figure of eight, seconds.
const EIGHT: f32 = 6.0;

impl Target {
    pub(crate) fn new(room: &Room) -> Self {
        Self { place: room.point(0.7, 0.25, 1.4), path: Path::Still, time: 0.0 }
    }

    /// Returns the current position, world space.
    pub(crate) fn at(&self, room: &Room) -> Vec3 {
        let t = self.time;
        let phase = |seconds: f32| std::f32::consts::TAU * t / seconds;
        match self.path {
            Path::Still => self.place,
            Path::Orbit => {
                let (sin, cos) = phase(ORBIT).sin_cos();
                room.point(1.6 * sin, 0.15, 1.6 * cos)
            }
            Path::Eight => {
                let (sin, cos) = phase(EIGHT).sin_cos();
                room.point(0.9 * sin, 0.1 + 0.6 * sin * cos, 1.3)
            }
            // The least common multiple of the periods is long.
            Path::Noise => room.point(
                0.7 * phase(7.3).sin() + 0.3 * phase(2.9).sin(),
                0.1 + 0.3 * phase(5.1).sin() + 0.2 * phase(1.9).sin(),
                1.4 + 0.4 * phase(11.7).sin(),
            ),
        }
    }

    /// Changes the path. With [`Path::Still`] the target stays where it is.
    pub(crate) fn follow(&mut self, room: &Room, path: Path) {
        if path == Path::Still {
            self.place = self.at(room);
        }
        self.path = path;
    }

    /// Samples future positions on the path.
    pub(crate) fn way(&self, room: &Room) -> impl Iterator<Item = Vec3> {
        let (target, room) = (*self, *room);
        let steps: u8 = if self.path == Path::Still { 1 } else { 32 };
        (0..steps).map(move |step| Self { time: target.time + f32::from(step) * 0.4, ..target }.at(&room))
    }

    /// Moves the target by hand. This ends its path at the present position.
    pub(crate) fn move_by(&mut self, room: &Room, by: Vec3) {
        self.place = self.at(room) + by;
        self.path = Path::Still;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn room() -> Room {
        Room { centre: Vec3::Y, directions: [Vec3::Y, Vec3::Z, Vec3::X], metre: 2.0 }
    }

    #[test]
    fn paths_are_continuous_and_of_the_size_of_the_character() {
        let room = room();
        for path in Path::ALL {
            let at = |time: f32| Target { path, time, ..Target::new(&room) }.at(&room);
            for frame in 0..2000_u16 {
                let (t, next) = (f32::from(frame) / 60.0, f32::from(frame + 1) / 60.0);
                assert!(at(t).distance(at(next)) < 0.12, "{path:?} jumps at {t}");
                assert!(at(t).distance(room.centre) < 6.0 && at(t).distance(room.centre) > 0.5, "{path:?} at {t}");
            }
        }
    }

    #[test]
    fn a_target_that_is_moved_leaves_its_path_where_it_is() {
        let room = room();
        let mut target = Target { path: Path::Orbit, time: 2.0, ..Target::new(&room) };
        let before = target.at(&room);
        target.move_by(&room, Vec3::X);
        target.time += 1.0;
        assert_eq!((target.path, target.at(&room)), (Path::Still, before + Vec3::X));
    }
}

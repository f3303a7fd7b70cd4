//! Targets of a bake: the values of `bake --target`.

use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use aim_character::Measurement;
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3};

use crate::failure::{Failure, Result};

/// A target as the user wrote it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum TargetSpec {
    /// A point in the world.
    Point(DVec3),
    /// A circle around the effector in the bind pose: radius and height in metres of a 1.7 m character, and seconds per
    /// turn.
    Orbit { radius: f64, height: f64, seconds: f64 },
    /// A node of the file, by name.
    Node(String),
    /// Path of a CSV file with the columns t, x, y, z.
    File(PathBuf),
}

impl FromStr for TargetSpec {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        const EXPECTED: &str = "expected x,y,z · orbit:RADIUS,HEIGHT,SECONDS · node:NAME · file:PATH.csv";
        match text.split_once(':') {
            Some(("orbit", orbit)) => {
                let [radius, height, seconds] = three_numbers(orbit)
                    .ok_or("orbit: expected radius, height and seconds per turn, such as orbit:2,0,8")?;
                if radius <= 0.0 || seconds.abs() < 1e-6 {
                    return Err("orbit: expected a positive radius and seconds per turn that are not 0".into());
                }
                Ok(Self::Orbit { radius, height, seconds })
            }
            Some(("node", "")) => Err("node: expected a node's name".into()),
            Some(("node", name)) => Ok(Self::Node(name.into())),
            Some(("file", "")) => Err("file: expected the path of a CSV file".into()),
            Some(("file", path)) => Ok(Self::File(path.into())),
            _ => three_numbers(text).map(|p| Self::Point(DVec3::from_array(p))).ok_or_else(|| EXPECTED.into()),
        }
    }
}

/// A point as the user wrote it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point(pub(crate) DVec3);

impl FromStr for Point {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let numbers = three_numbers(text).ok_or("expected three numbers, such as 0.3,1.5,0.6")?;
        Ok(Self(DVec3::from_array(numbers)))
    }
}

fn three_numbers(text: &str) -> Option<[f64; 3]> {
    let numbers: Vec<f64> =
        text.split(',').map(|n| n.trim().parse().ok().filter(|x| is_usable(*x))).collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// Returns `true` if a number fits into single precision, which files use.
fn is_usable(x: f64) -> bool {
    x.abs() <= f64::from(f32::MAX)
}

/// Function that returns the target's place in the world, given a time in seconds and the world transforms of the
/// file's nodes.
pub(crate) type Target = Box<dyn Fn(f64, &[DAffine3]) -> DVec3>;

impl TargetSpec {
    /// Resolves the target in `document`. `effector_bind` is the effector's origin in the bind pose.
    ///
    /// # Errors
    /// There is no such node, or the CSV file cannot be read or parsed.
    pub(crate) fn resolve(
        &self,
        file: &Path,
        document: &Document,
        measurement: &Measurement,
        effector_bind: DVec3,
    ) -> Result<Target> {
        Ok(match self {
            &Self::Point(point) => Box::new(move |_, _| point),
            Self::Orbit { radius, height, seconds } => {
                let metre = measurement.metre();
                let [front, left] = [measurement.forward, measurement.left].map(|way| way * (radius * metre));
                let (up, turns_a_second) = (measurement.up * (height * metre), seconds.recip());
                Box::new(move |t, _| {
                    let (sin, cos) = (t * turns_a_second * std::f64::consts::TAU).sin_cos();
                    effector_bind + front * cos + left * sin + up
                })
            }
            Self::Node(name) => {
                let node = document.skeleton().find(name).map_err(|error| Failure::in_file(file, error))?;
                Box::new(move |_, world| world[node].translation)
            }
            Self::File(path) => {
                let rows = read_path(path)?;
                Box::new(move |t, _| on_path(&rows, t))
            }
        })
    }
}

/// Returns the point of a path at time `t`: linear between rows, constant before the first and after the last.
fn on_path(rows: &[(f64, DVec3)], t: f64) -> DVec3 {
    let after = rows.partition_point(|(time, _)| *time <= t);
    match (after.checked_sub(1).map(|i| rows[i]), rows.get(after)) {
        (Some((t0, p0)), Some(&(t1, p1))) => p0.lerp(p1, (t - t0) / (t1 - t0)),
        (Some((_, last)), None) => last,
        (None, Some(&(_, first))) => first,
        (None, None) => DVec3::ZERO,
    }
}

fn read_path(path: &Path) -> Result<Vec<(f64, DVec3)>> {
    let fail = |problem: String| Failure::in_file(path, problem);
    let text = fs::read_to_string(path)
        .map_err(|error| fail(format!("cannot read as text: {error}; expected a CSV file with the columns t,x,y,z")))?;
    parse_path(&text).map_err(fail)
}

/// Parses the rows of a CSV file with the columns t,x,y,z, sorted by t. Empty lines are ignored.
fn parse_path(text: &str) -> std::result::Result<Vec<(f64, DVec3)>, String> {
    // Spreadsheets write a byte-order mark first.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let cells = |line: &str| line.split(',').map(|cell| cell.trim().trim_matches('"').to_owned()).collect::<Vec<_>>();
    let mut lines = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty());
    let header = lines.next().map_or("", |(line, _)| line);
    if cells(header) != ["t", "x", "y", "z"] {
        return Err(format!("the first line is {header:?}; expected t,x,y,z"));
    }
    let mut rows: Vec<(f64, DVec3)> = Vec::new();
    for (line, number) in lines {
        let numbers: Option<Vec<f64>> = cells(line).iter().map(|cell| cell.parse().ok()).collect();
        let Some([t, x, y, z]) = numbers.and_then(|numbers| <[f64; 4]>::try_from(numbers).ok()) else {
            return Err(format!("line {number}: expected four numbers t,x,y,z, found {line:?}"));
        };
        if ![t, x, y, z].into_iter().all(is_usable) {
            return Err(format!("line {number}: a number is not finite or exceeds the range of single precision"));
        }
        if rows.last().is_some_and(|(before, _)| *before >= t) {
            return Err(format!(
                "line {number}: the time {t} is not after that of the previous row; sort the rows by t"
            ));
        }
        rows.push((t, DVec3::new(x, y, z)));
    }
    if rows.is_empty() {
        return Err("no rows; add at least one line of t,x,y,z".into());
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn specs_are_read() {
        assert_eq!("1, -2,3e0".parse(), Ok(TargetSpec::Point(DVec3::new(1.0, -2.0, 3.0))));
        assert_eq!("orbit:2,0,8".parse(), Ok(TargetSpec::Orbit { radius: 2.0, height: 0.0, seconds: 8.0 }));
        assert_eq!("node:Head".parse(), Ok(TargetSpec::Node("Head".into())));
        assert_eq!("file:a/b.csv".parse(), Ok(TargetSpec::File("a/b.csv".into())));
    }

    #[test]
    fn wrong_specs_say_what_was_expected() {
        for text in
            ["", "1,2", "1,2,x", "NaN,0,0", "orbit:", "orbit:1,2", "orbit:-1,0,8", "orbit:1,0,0", "node:", "file:"]
        {
            let error = text.parse::<TargetSpec>().expect_err(text);
            assert!(error.contains("expected"), "{text}: {error}");
        }
    }

    #[test]
    fn paths_are_linear_between_rows_and_stand_still_outside() {
        let rows = [(1.0, DVec3::ZERO), (2.0, DVec3::X), (4.0, DVec3::Y)];
        assert_eq!(on_path(&rows, 0.0), DVec3::ZERO);
        assert_eq!(on_path(&rows, 1.5), DVec3::X * 0.5);
        assert_eq!(on_path(&rows, 3.0), DVec3::new(0.5, 0.5, 0.0));
        assert_eq!(on_path(&rows, 9.0), DVec3::Y);
    }
}

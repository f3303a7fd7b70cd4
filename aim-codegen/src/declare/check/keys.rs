//! The keys of each group of settings, with what the value of each has to be.

use crate::declare::report::messages::Expected;

/// A known key and what its value has to be.
pub(super) type Key = (&'static str, Expected);

/// What a rig may say; `crate` in a macro only, `joint` in TOML only.
pub(super) const RIG_KEYS: &[Key] = &[
    ("axes", Expected::Axes),
    ("handedness", Expected::Side),
    ("effector", Expected::Effector),
    ("natural", Expected::Natural),
    ("kernels", Expected::Kernels),
    ("crate", Expected::Path),
    ("joint", Expected::Joints),
];

/// What a joint may say.
pub(super) const JOINT_KEYS: &[Key] = &[
    ("role", Expected::Role),
    ("heading", Expected::HeadingRange),
    ("pitch", Expected::AngleRange),
    ("rate", Expected::Rate),
    ("acceleration", Expected::Acceleration),
    ("stiffness", Expected::Number),
    ("upright", Expected::Number),
    ("pitch_taper", Expected::Number),
    ("limits_from", Expected::LimitsFrom),
    ("bone", Expected::NodeNames),
    ("other_eye", Expected::NodeName),
    ("axes", Expected::Axes),
    ("mirrored", Expected::Flag),
];

/// What `effector` may say.
pub(super) const EFFECTOR_KEYS: &[Key] = &[("forward", Expected::Direction), ("origin", Expected::Point)];

/// What `natural` may say.
pub(super) const NATURAL_KEYS: &[Key] = &[
    ("eyes_only", Expected::Angle),
    ("head_share", Expected::Number),
    ("engage", Expected::Angle),
    ("release", Expected::Angle),
    ("delay", Expected::Seconds),
];

/// What `axes` may say; each direction is followed by its opposite.
pub(super) const AXES_KEYS: [Key; 6] = [
    ("up", Expected::Direction),
    ("down", Expected::Direction),
    ("forward", Expected::Direction),
    ("back", Expected::Direction),
    ("left", Expected::Direction),
    ("right", Expected::Direction),
];

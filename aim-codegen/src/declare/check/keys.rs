//! Keys of each group of settings, with the expected form of each value.

use crate::declare::report::expected::Expected;

/// A known key and the expected form of its value.
pub(crate) type Key = (&'static str, Expected);

/// Keys of a rig; `crate` in the macro only, `joint` in TOML only.
pub(super) const RIG_KEYS: &[Key] = &[
    ("axes", Expected::AXES),
    ("handedness", Expected::SIDE),
    ("effector", Expected::EFFECTOR),
    ("natural", Expected::NATURAL),
    ("region", Expected::REGION),
    ("kernels", Expected::KERNELS),
    ("crate", Expected::PATH),
    ("joint", Expected::JOINTS),
];

/// Keys of a joint.
pub(super) const JOINT_KEYS: &[Key] = &[
    ("role", Expected::ROLE),
    ("heading", Expected::HEADING_RANGE),
    ("pitch", Expected::ANGLE_RANGE),
    ("rate", Expected::RATE),
    ("acceleration", Expected::ACCELERATION),
    ("stiffness", Expected::NUMBER),
    ("upright", Expected::NUMBER),
    ("pitch_taper", Expected::NUMBER),
    ("limits_from", Expected::LIMITS_FROM),
    ("bone", Expected::NODE_NAMES),
    ("other_eye", Expected::NODE_NAME),
    ("hold", Expected::HELD_NAMES),
    ("axes", Expected::AXES),
    ("mirrored", Expected::FLAG),
];

/// Keys of `effector`.
pub(super) const EFFECTOR_KEYS: &[Key] = &[("forward", Expected::DIRECTION), ("origin", Expected::POINT)];

/// Keys of `natural`.
pub(super) const NATURAL_KEYS: &[Key] = &[
    ("eyes_only", Expected::ANGLE),
    ("head_share", Expected::NUMBER),
    ("engage", Expected::ANGLE),
    ("release", Expected::ANGLE),
    ("delay", Expected::SECONDS),
];

/// Keys of `region`.
pub(super) const REGION_KEYS: &[Key] =
    &[("like", Expected::BODY), ("head", Expected::BUDGET), ("chest", Expected::BUDGET)];

/// Keys of a region's budget.
pub(super) const BUDGET_KEYS: &[Key] = &[
    ("heading", Expected::ANGLE_RANGE),
    ("pitch", Expected::ANGLE_RANGE),
    ("rate", Expected::RATE),
    ("acceleration", Expected::ACCELERATION),
];

/// Keys of `axes`; each direction is followed by its opposite.
pub(super) const AXES_KEYS: [Key; 6] = [
    ("up", Expected::DIRECTION),
    ("down", Expected::DIRECTION),
    ("forward", Expected::DIRECTION),
    ("back", Expected::DIRECTION),
    ("left", Expected::DIRECTION),
    ("right", Expected::DIRECTION),
];

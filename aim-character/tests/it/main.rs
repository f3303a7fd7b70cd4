//! Declarations proposed for characters, and rigs interpreted on them.

mod declaration;
mod mixed_rigs;
mod names;

/// The bundled rigs, as their users may copy them.
const RIGS: [(&str, &str); 8] = [
    ("mannequin", include_str!("../../../rigs/mannequin.toml")),
    ("mixamo", include_str!("../../../rigs/mixamo.toml")),
    ("rigify", include_str!("../../../rigs/rigify.toml")),
    ("rocketbox", include_str!("../../../rigs/rocketbox.toml")),
    ("thug", include_str!("../../../rigs/thug.toml")),
    ("turret", include_str!("../../../rigs/turret.toml")),
    ("unreal", include_str!("../../../rigs/unreal.toml")),
    ("vrm", include_str!("../../../rigs/vrm.toml")),
];

//! Integration tests: a whole app without a window, checked in double precision by Bevy's own `GlobalTransform` after
//! propagation.

mod by_hand;
mod events;
mod finding;
mod hostile;
mod loaded;
#[rustfmt::skip]
#[allow(clippy::doc_markdown, missing_debug_implementations, unnameable_types, reason = "as it is printed")]
mod mannequin;
mod printed;
mod scene;
mod stage;
mod targets;
mod time;

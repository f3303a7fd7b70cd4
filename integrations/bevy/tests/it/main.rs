//! A whole app without a window, judged by Bevy's own `GlobalTransform` after propagation, in double precision.

mod by_hand;
mod events;
mod finding;
mod scene;
mod stage;
mod targets;
mod time;

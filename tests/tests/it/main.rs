//! The public API as users see it, checked by independent oracles.

mod accuracy;
mod book;
mod bundled;
mod by_hand;
mod counts;
mod dependencies;
mod derivation;
mod differentiate;
mod elsewhere;
mod emitted;
mod expanded;
mod golden;
mod gradients;
mod held;
mod inlined;
mod kernels;
mod lanes;
mod mannequin;
mod natural_gaze;
mod random;
mod same_code;
mod settling;
mod stored;
mod wgsl;

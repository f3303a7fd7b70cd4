//! `aim plot`: the aim function of one joint as a picture, with the paths of the solvers.
//!
//! All values come from the rig's derived program and all paths from the runtime; this module only draws them. The same
//! rig gives the same bytes.

mod bands;
mod contours;
mod curve;
mod key;
mod labels;
mod layout;
mod picture;
mod subject;
mod surface;

pub(crate) use picture::{PlotPicture, Size};
pub(crate) use subject::JointPlot;

/// Draws the aim over both angles as contours, or over the only angle of a hinge as a curve.
pub(crate) fn flat(subject: &JointPlot, size: Size) -> PlotPicture {
    if subject.is_hinge() { curve::picture(subject, size) } else { contours::picture(subject, size) }
}

/// Draws the aim over both angles as a surface in space.
///
/// # Errors
/// The joint has only one angle.
pub(crate) fn surface(subject: &JointPlot, size: Size) -> Result<PlotPicture, String> {
    if subject.is_hinge() {
        return Err(format!(
            "the joint {} has only one angle, so it has no surface; omit --surface to draw its curve",
            subject.joint.name
        ));
    }
    Ok(surface::picture(subject, size))
}

//! `aim plot`: the aim function of one joint as a picture, with the solvers' ways over it.
//!
//! Every value is the rig's derived program's, every way is the runtime's; here both are only drawn. The same rig gives
//! the same bytes.

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

/// The aim over both angles as contours, over the only angle of a hinge as a curve.
pub(crate) fn flat(subject: &JointPlot, size: Size) -> PlotPicture {
    if subject.is_hinge() { curve::picture(subject, size) } else { contours::picture(subject, size) }
}

/// The aim over both angles as a surface in space.
///
/// # Errors
/// The joint has one angle only.
pub(crate) fn surface(subject: &JointPlot, size: Size) -> Result<PlotPicture, String> {
    if subject.is_hinge() {
        return Err(format!(
            "the joint {} has one angle, over which there is no surface; leave --surface out for its curve",
            subject.joint.name
        ));
    }
    Ok(surface::picture(subject, size))
}

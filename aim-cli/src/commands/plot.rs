//! `aim plot`: draws the aim function of a joint.

use crate::args;
use crate::failure::{Failure, Result};
use crate::files;
use crate::outputs::Outputs;
use crate::plot::{self, JointPlot};

pub(super) fn run(arguments: &args::Plot) -> Result {
    let as_png = match &*files::ending(&arguments.output) {
        "svg" => false,
        "png" => true,
        _ => {
            return Err(Failure::in_file(
                &arguments.output,
                "unknown extension; use a name that ends in .svg or .png with -o",
            ));
        }
    };
    let spec = files::load_rig(&arguments.rig)?;
    Outputs::reading([(Some(&arguments.rig), "the rig")]).writes(&arguments.output, "-o")?;
    let fail = |problem| Failure::in_file(&arguments.rig, problem);
    let target = arguments.target.map(|point| point.0);
    let subject = JointPlot::new(&spec, arguments.joint.as_deref(), target).map_err(fail)?;
    let picture = if arguments.surface {
        plot::surface(&subject, arguments.size).map_err(fail)?
    } else {
        plot::flat(&subject, arguments.size)
    };
    if as_png {
        files::write(&arguments.output, &picture.png()?)
    } else {
        files::write(&arguments.output, picture.svg().as_bytes())
    }
}

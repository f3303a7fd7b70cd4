//! Aims every pasted rig; `paste-rigs` adds the modules and `main`.

use aim::glam::{Affine3A, Mat3A, Vec3, Vec3A};
use aim::{AimRig, Pose, Status};

/// A rig whose bones stand one above the other, each as its own axes say, looks to its left and a little up.
fn aims<R: AimRig + Default>(name: &str) {
    let mut rig = R::default();
    let axes: Vec<_> = rig.joint_infos().iter().map(|info| info.axes()).collect();
    let mut joints = rig.array(Affine3A::IDENTITY);
    let mut height = 1.7;
    for (place, axes) in joints.as_mut().iter_mut().zip(axes) {
        let [left, up, forward] = [axes.left, axes.up, axes.forward].map(Vec3A::from_array);
        // The character's left is +X, its up +Y, its forward +Z.
        let bone = Mat3A::from_cols(left, up, forward).transpose();
        *place = Affine3A { matrix3: bone, translation: Vec3A::new(0.0, height, 0.0) };
        height -= 0.15;
    }
    let outcome = rig.snap(&Pose { joints }, Vec3::new(0.4, 1.8, 2.0));
    assert_eq!(outcome.status, Status::Reached, "{name}: {outcome:?}");
    println!("{name}: {} joints aim", rig.joint_infos().len());
}


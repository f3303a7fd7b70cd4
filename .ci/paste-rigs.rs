//! Aims every pasted rig; `paste-rigs` adds the modules and `main`.

use aim::glam::{Affine3A, Mat3A, Vec3, Vec3A};
use aim::{Aim, AimRig, Pose, Settings, Status};

/// A rig whose bones stand one above the other, each as its own axes say, looks to its left and a little up.
fn aims<R: AimRig>(name: &str) {
    let infos = R::RIG.description().joints();
    let mut joints = R::array(Affine3A::IDENTITY);
    let mut height = 1.7;
    for (place, info) in joints.as_mut().iter_mut().zip(infos) {
        let axes = info.axes();
        let [left, up, forward] = [axes.left, axes.up, axes.forward].map(Vec3A::from_array);
        // The character's left is +X, its up +Y, its forward +Z.
        let bone = Mat3A::from_cols(left, up, forward).transpose();
        *place = Affine3A { matrix3: bone, translation: Vec3A::new(0.0, height, 0.0) };
        height -= 0.15;
    }
    let aimed = Aim::<R>::new().snap(&Pose::new(joints), Vec3::new(0.4, 1.8, 2.0), &Settings::default());
    assert_eq!(aimed.outcome.status, Status::Reached, "{name}: {:?}", aimed.outcome);
    println!("{name}: {} joints aim", infos.len());
}


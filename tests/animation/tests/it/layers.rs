//! The aim layer equals gather, aim and apply, bit for bit.

use aim::animation::{AimChain, AimLayer, Figure, PoseError, Transform};
use aim::glam::{Affine3A, Quat, Vec3};
use aim::{AimRig, DynAim, Settings, Status};
use aim_animation_tests::{Hero, gait, skeleton};

#[test]
fn an_aim_layer_is_gather_aim_and_apply() {
    let skeleton = skeleton(Transform::IDENTITY);
    let chain = AimChain::named(&skeleton, Hero::RIG).unwrap();
    let (walk, mut figure) = (gait(&skeleton, "walk", 1.0, 0.0), Figure::new(skeleton.clone()));
    let (mut layer, mut by_hand) = (AimLayer::new(chain.clone(), Hero::RIG), DynAim::new(Hero::RIG));
    assert!(layer.outcome().is_none());
    let (mut frame, target) = (chain.frame(), Vec3::new(2.0, 1.9, 3.0));
    layer.target = target;
    for number in 0..90_u8 {
        let time = f32::from(number) / 60.0;
        figure.place = Transform::new(Vec3::Z * time, Quat::from_rotation_y(0.2 * time));
        let mut animation = |figure: &mut Figure, _: f32| {
            figure.edit(|local| {
                walk.sample(time % 1.0, &mut walk.cursor(), local);
                Ok::<(), PoseError>(())
            })
        };
        figure.run(1.0 / 60.0, &mut [&mut animation, &mut layer]).unwrap();
        let (mut local, mut model) = (skeleton.rest().to_vec(), vec![Affine3A::IDENTITY; skeleton.len()]);
        walk.sample(time % 1.0, &mut walk.cursor(), &mut local);
        skeleton.to_model(&local, &mut model).unwrap();
        frame.place = figure.place.to_affine();
        chain.gather(&mut frame, &mut local, &mut model).unwrap();
        let outcome = by_hand.aim(&frame.pose(), target, 1.0 / 60.0, &Settings::default());
        chain.apply(&frame, (&by_hand).into(), &mut local, &mut model).unwrap();
        assert_eq!(layer.outcome(), Some(&outcome));
        assert_eq!((figure.local(), figure.model()), (&local[..], &model[..]));
    }
    assert_eq!(layer.outcome().unwrap().status, Status::Reached);
}

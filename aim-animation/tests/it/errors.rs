//! Error messages say what is wrong and where.

use aim_animation::glam::{Quat, Vec2, Vec3};
use aim_animation::{
    AimChainError, BlendLine, BlendPlane, Bone, Clip, Marks, Mask, MotionError, Node, Parameter, PoseError, Reach,
    ReachError, ReachGoal, Root, RootPath, Skeleton, Track, Transform, Tree,
};

fn skeleton() -> Skeleton {
    Skeleton::new([Bone::new("hips", None), Bone::new("leg", Some(0)), Bone::new("foot", Some(1))]).unwrap()
}

/// Each message contains the expected words.
#[test]
fn error_messages_contain_the_expected_words() {
    let skeleton = skeleton();
    let clip = Clip::new("c").with_length(1.0);
    let nowhere = Transform::from_translation(Vec3::NAN);
    let path = |root, rate| RootPath::new(&clip, &skeleton, root, rate).unwrap_err();
    let up = |up| path(Root::Shadow { bone: 0, up }, 30.0);
    let tree = |node| Tree::new(&skeleton, node).unwrap_err().to_string();
    let reach = |limb: &[usize]| Reach::new(&clip, &skeleton, limb, 30.0).unwrap_err().to_string();
    let leg = Skeleton::new([0, 1, 2].map(|bone: usize| {
        let rest = Transform::from_translation(Vec3::X);
        Bone::new("leg", bone.checked_sub(1)).with_rest(rest)
    }));
    let leg = Reach::new(&clip, &leg.unwrap(), [0, 1, 2], 30.0).unwrap();
    let aim = |times: &[f32]| {
        let goals: Vec<ReachGoal> = times.iter().map(|time| ReachGoal::new(*time, Vec3::X)).collect();
        leg.aim(&mut leg.state(), &goals, 0.0).unwrap_err().to_string()
    };
    let short = Node::source(0).with_mask(Mask::new(&skeleton, 1.0));
    let line = BlendLine::new([0.0, 1.0]).unwrap();
    let places = Node::line(line, Parameter::Input(0), [Node::source(0)]);
    let one = Skeleton::new([Bone::new("b", None)]).unwrap();
    let foreign = Node::source(0).blend(Node::source(1), 0.5).with_mask(Mask::new(&one, 1.0));
    for (message, words) in [
        (Skeleton::new([Bone::new("b", Some(7))]).unwrap_err().to_string(), &["parent", "7", "does not exist"][..]),
        (Skeleton::new([Bone::new("b", Some(0))]).unwrap_err().to_string(), &["bone 0", "ancestor"]),
        (Skeleton::new([Bone::new("b", None).with_rest(nowhere)]).unwrap_err().to_string(), &["rest", "bone 0"]),
        (PoseError::Length { bones: 3, found: 2 }.to_string(), &["2", "3 bones"]),
        (PoseError::Flat(4).to_string(), &["bone 4", "flat"]),
        (Track::linear([0.0], [f32::NAN]).unwrap_err().to_string(), &["key 0"]),
        (Track::linear([1.0, 0.0], [0.0; 2]).unwrap_err().to_string(), &["key 1"]),
        (Track::linear([0.0], [0.0; 2]).unwrap_err().to_string(), &["1", "2"]),
        (Track::<f32>::linear([0.0; 0], []).unwrap_err().to_string(), &["key"]),
        (Track::constant(Quat::from_xyzw(0.0, 0.0, 0.0, 0.0)).unwrap_err().to_string(), &["key 0"]),
        (Marks::new(0.0, [0.0]).unwrap_err().to_string(), &["length"]),
        (Marks::new(1.0, []).unwrap_err().to_string(), &["no mark"]),
        (Marks::new(1.0, [0.5, 0.5]).unwrap_err().to_string(), &["mark 1"]),
        (BlendLine::new([]).unwrap_err().to_string(), &["at least one"]),
        (BlendLine::new([f32::NAN]).unwrap_err().to_string(), &["place 0"]),
        (BlendLine::new([1.0, 1.0]).unwrap_err().to_string(), &["place 1"]),
        (BlendPlane::new([Vec2::ZERO, Vec2::X, Vec2::X * 2.0]).unwrap_err().to_string(), &["line"]),
        (path(Root::Bone(9), 30.0).to_string(), &["bone 9"]),
        (path(Root::Bone(0), 0.0).to_string(), &["length", "rate"]),
        (up(Vec3::ZERO).to_string(), &["up"]),
        (MotionError::Place.to_string(), &["not finite"]),
        (tree(short), &["mask"]),
        (tree(places), &["1 nodes", "2 places"]),
        (tree(foreign), &["mask", "1 bones", "3 bones"]),
        (reach(&[0]), &["bone 1", "limb"]),
        (reach(&[0, 1, 2]), &["length"]),
        (aim(&[3.0]), &["goal 0"]),
        (aim(&[0.5, 0.5]), &["goal 1"]),
        (ReachError::State.to_string(), &["state"]),
        (AimChainError::Empty.to_string(), &["joint"]),
        (AimChainError::Joint(2).to_string(), &["joint 2"]),
        (AimChainError::Names { joint: 2, names: vec!["jaw".into()] }.to_string(), &["joint 2", "\"jaw\""]),
        (AimChainError::Names { joint: 2, names: vec![] }.to_string(), &["joint 2", "`bone = "]),
        (AimChainError::Order(2).to_string(), &["joint 1", "joint 2"]),
        (AimChainError::OtherEye.to_string(), &["eye"]),
        (AimChainError::Trunk.to_string(), &["trunk"]),
        (AimChainError::Held.to_string(), &["held"]),
    ] {
        println!("{message}");
        for word in words {
            assert!(message.contains(word), "{word:?} is not in {message:?}");
        }
        assert!(!message.ends_with('.') && message.starts_with(|first: char| !first.is_uppercase()), "{message}");
    }
}

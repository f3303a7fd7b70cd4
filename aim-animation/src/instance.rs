//! [`Instance`]: one character, where it is and what it plays.

use alloc::vec::Vec;

use aim_runtime::glam::Affine3A;

use crate::attach::attached;
use crate::blend::{BoneSum, Method};
use crate::clip::{Event, events_passed};
use crate::control::Control;
use crate::cursor::Cursor;
use crate::figure::{Figure, Layer, place_for};
use crate::mask::clamped;
use crate::model::Model;
use crate::motion::Motion;
use crate::pose::{PoseError, check_length};
use crate::step::Step;
use crate::transform::Transform;

/// A clip that an instance plays: which, where it is in it and how fast, and how much it counts.
///
/// ```
/// use aim_animation::{Bone, Clip, ClipControl, Instance, Model, Skeleton, Track};
/// use aim_animation::glam::Vec3;
///
/// let at = |name, x| Clip::new(name).with_translation(0, Track::constant(Vec3::X * x).unwrap());
/// let model = Model::new(Skeleton::new([Bone::new("hips", None)])?, [at("walk", 0.0), at("run", 1.0)]);
/// let mut hero = Instance::new(&model);
/// hero.play(ClipControl::new(0));
/// let run = hero.play(ClipControl::new(1).with_weight(0.0));
///
/// // A quarter of the way from walking to running.
/// (hero.controls_mut()[0].weight, hero.controls_mut()[run].weight) = (0.75, 0.25);
/// let mut local = model.skeleton().rest().to_vec();
/// hero.pose(&model, &mut local)?;
/// assert_eq!(local[0].translation.x, 0.25);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipControl {
    /// The number of the clip in its [`Model`].
    pub clip: usize,
    /// Local time, speed, looping.
    pub control: Control,
    /// Its weight beside the others, 0…1; NaN counts as 0. At 0 it goes on, but is not sampled.
    pub weight: f32,
    /// The number of a mask of the model, by which its weight is multiplied bone by bone; `None` for all bones. Of a mask that the model
    /// does not have no bone counts.
    pub mask: Option<usize>,
}

impl ClipControl {
    /// A clip from its beginning, at speed 1, repeating, with full weight for all bones.
    #[must_use]
    pub const fn new(clip: usize) -> Self {
        Self { clip, control: Control::new(), weight: 1.0, mask: None }
    }

    /// With where it is, how fast it is and what becomes of it at its ends.
    #[must_use]
    pub const fn with_control(mut self, control: Control) -> Self {
        self.control = control;
        self
    }

    /// With a weight.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }

    /// With a mask of the model.
    #[must_use]
    pub const fn with_mask(mut self, mask: usize) -> Self {
        self.mask = Some(mask);
        self
    }

    /// The weight of a bone.
    fn weight_of(&self, model: &Model, bone: usize) -> f32 {
        let mask = self.mask.map_or(1.0, |mask| {
            let mask = model.masks().get(mask).and_then(|mask| mask.weights().get(bone));
            mask.copied().unwrap_or(0.0)
        });
        clamped(self.weight) * mask
    }
}

/// One character: its place, the clips that it plays, and the things that it carries.
///
/// [`advance`](Self::advance) moves all its clips on by one frame, and its place by their root motion: no pose is evaluated for
/// that. [`pose`](Self::pose) is the weighted mean of what it plays: a clip of weight 1 beside another of weight 1 comes half through,
/// and bones that it has no tracks for count as at rest. What takes the place of another clip (a layer), a blend space and an
/// additive clip are a [`Tree`](crate::Tree), which has its own memory beside; [`steps`](Self::steps) has the times to sample at.
///
/// ```
/// use aim_animation::glam::Vec3;
/// use aim_animation::{Bone, Clip, ClipControl, Instance, Model, Motion, Root, RootPath, Skeleton, Track, Transform};
///
/// let skeleton = Skeleton::new([Bone::new("hips", None)])?;
/// let stride = Track::linear([0.0, 1.0], [Vec3::Y, Vec3::Y + 1.4 * Vec3::Z])?;
/// let walk = Clip::new("walk").with_translation(0, stride).with_event(0.5, "step")?;
/// let path = RootPath::new(&walk, &skeleton, Root::Shadow { bone: 0, up: Vec3::Y }, 30.0)?;
/// let model = Model::new(skeleton, [walk]).with_motion(0, Motion::linear(&path));
///
/// // Once a character:
/// let mut hero = Instance::new(&model);
/// hero.place = Transform::from_translation(Vec3::X);
/// hero.play(ClipControl::new(0));
/// // Each frame:
/// hero.advance(&model, 0.75);
/// let steps: Vec<&str> = hero.events(&model).map(|(_, event)| event.name.as_str()).collect();
/// let mut local = model.skeleton().rest().to_vec();
/// hero.pose(&model, &mut local)?;
/// assert_eq!((steps, local[0].translation), (vec!["step"], Vec3::Y));
/// assert!(hero.place.translation.distance(Vec3::new(1.0, 0.0, 1.05)) < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// The character in the world, without scale.
    pub place: Transform,
    controls: Vec<ClipControl>,
    /// Of each control.
    cursors: Vec<Cursor>,
    /// That of the model, at the beginning.
    cursor: Cursor,
    steps: Vec<Step>,
    /// Bones, and what they hold in their space.
    things: Vec<(usize, Affine3A)>,
    scratch: Vec<Transform>,
    sums: Vec<BoneSum>,
}

impl Instance {
    /// A character of this kind that stands at the origin and plays nothing yet.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let bones = model.skeleton().len();
        Self {
            place: Transform::IDENTITY,
            controls: Vec::new(),
            cursors: Vec::new(),
            cursor: model.cursor().clone(),
            steps: Vec::new(),
            things: Vec::new(),
            scratch: alloc::vec![Transform::IDENTITY; bones],
            sums: alloc::vec![BoneSum::ZERO; bones],
        }
    }

    /// Plays one more clip, and gives its number among the [controls](Self::controls).
    pub fn play(&mut self, control: ClipControl) -> usize {
        self.controls.push(control);
        self.cursors.push(self.cursor.clone());
        self.steps.push(Step::none(0.0, 0.0));
        self.controls.len() - 1
    }

    /// Stops a clip; those behind it move up by one. Nothing is done if there is no such control.
    pub fn stop(&mut self, control: usize) {
        if control < self.controls.len() {
            self.controls.remove(control);
            self.cursors.remove(control);
            self.steps.remove(control);
        }
    }

    /// The clips that it plays.
    #[must_use]
    pub fn controls(&self) -> &[ClipControl] {
        &self.controls
    }

    /// The clips that it plays, to set their weights, speeds and times.
    pub fn controls_mut(&mut self) -> &mut [ClipControl] {
        &mut self.controls
    }

    /// The way of each clip in the last [`advance`](Self::advance).
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Has a bone hold a thing, `grip` in the space of the bone, and gives its number among the [things](Self::things).
    ///
    /// ```
    /// use aim_animation::glam::{Affine3A, Vec3};
    /// use aim_animation::{Bone, Instance, Model, Skeleton, Transform};
    ///
    /// let model = Model::new(Skeleton::new([Bone::new("hand", None)])?, []);
    /// let mut hero = Instance::new(&model);
    /// hero.place = Transform::from_translation(5.0 * Vec3::X);
    /// let lantern = hero.attach(0, Affine3A::from_translation(Vec3::NEG_Y));
    /// // Each frame, by the pose in the space of the model:
    /// let hand = [Affine3A::from_translation(Vec3::Y)];
    /// let (number, place) = hero.things(&hand).next().unwrap();
    /// assert_eq!((number, place.translation), (lantern, (5.0 * Vec3::X).into()));
    /// # Ok::<(), aim_animation::SkeletonError>(())
    /// ```
    pub fn attach(&mut self, bone: usize, grip: Affine3A) -> usize {
        self.things.push((bone, grip));
        self.things.len() - 1
    }

    /// Drops a thing; those behind it move up by one. Nothing is done if there is no such thing.
    pub fn detach(&mut self, thing: usize) {
        if thing < self.things.len() {
            self.things.remove(thing);
        }
    }

    /// Moves every clip on by `dt_s` seconds, and the place by their root motion: their weighted [mean](Motion::blend), by their
    /// weights for the bone whose movement it is. A clip without motion stands still, and counts, too: mask the root out of one
    /// that is not to slow the others down. Does not allocate.
    pub fn advance(&mut self, model: &Model, dt_s: f32) {
        for (playing, step) in self.controls.iter_mut().zip(&mut self.steps) {
            let length = model.played(playing.clip).map_or(0.0, |clip| clip.length_s());
            *step = playing.control.advance(dt_s, length);
        }
        let deltas = self.controls.iter().zip(&self.steps).map(|(playing, step)| {
            let delta = model.motion(playing.clip).map_or(Transform::IDENTITY, |motion| motion.delta(step));
            let is_clip = model.played(playing.clip).is_some();
            (delta, if is_clip { playing.weight_of(model, model.root_bone(playing.clip)) } else { 0.0 })
        });
        self.place = self.place.rigid_product(&Motion::blend(deltas));
    }

    /// The events that the last [`advance`](Self::advance) passed: control by control, of each in order, with its number. Clips without
    /// weight tell theirs, too, as they go on; the number leads to the weight.
    pub fn events<'a, 'm>(&'a self, model: &'m Model) -> impl Iterator<Item = (usize, &'m Event)> + use<'a, 'm> {
        self.controls.iter().zip(&self.steps).enumerate().flat_map(move |(number, (playing, step))| {
            let clip = model.played(playing.clip);
            clip.into_iter().flat_map(|clip| events_passed(clip.events(), step)).map(move |event| (number, event))
        })
    }

    /// Writes the pose, without the movement that the place has: for each bone the weighted sum of the clips, Σ wᵢ·poseᵢ / Σ wᵢ, as
    /// [`Blender::sum`](crate::Blender::sum) has it; where nothing has a weight the rest pose. Does not allocate.
    ///
    /// # Errors
    /// `local` has another length than the skeleton, or the instance is of a model with another number of bones; then nothing is
    /// written.
    pub fn pose(&mut self, model: &Model, local: &mut [Transform]) -> Result<(), PoseError> {
        let (skeleton, method) = (model.skeleton(), Method::Nlerp);
        check_length(skeleton.len(), local.len())?;
        check_length(skeleton.len(), self.scratch.len())?;
        self.sums.fill(BoneSum::ZERO);
        for (playing, cursor) in self.controls.iter().zip(&mut self.cursors) {
            let Some(clip) = model.played(playing.clip).filter(|_| playing.weight > 0.0) else { continue };
            let time = playing.control.time_s();
            self.scratch.copy_from_slice(skeleton.rest());
            clip.sample(time, cursor, &mut self.scratch);
            if let Some(motion) = model.motion(playing.clip) {
                motion.remove(time, skeleton, &mut self.scratch)?;
            }
            let terms = self.scratch.iter().zip(skeleton.rest());
            for (bone, (sum, (transform, rest))) in self.sums.iter_mut().zip(terms).enumerate() {
                sum.add(transform, rest, playing.weight_of(model, bone), method);
            }
        }
        for ((transform, sum), rest) in local.iter_mut().zip(&self.sums).zip(skeleton.rest()) {
            *transform = sum.finish(rest, method);
        }
        Ok(())
    }

    /// The layer that takes over the place and the pose of what it plays, where [`advance`](Self::advance) has led it: the first of a
    /// [`Figure`]'s frame.
    pub fn layer<'a>(&'a mut self, model: &'a Model) -> InstanceLayer<'a> {
        InstanceLayer { instance: self, model }
    }

    /// Moves the place so that a thing is at `held` in the world, by the pose in the space of the model: see [`Figure::hang`]. False, and
    /// nothing is done, if there is no such thing or bone, or if the result is not finite.
    pub fn hang(&mut self, thing: usize, model_pose: &[Affine3A], held: &Affine3A) -> bool {
        let place = self.things.get(thing).and_then(|(bone, grip)| {
            let attachment = attached(model_pose.get(*bone)?, grip);
            place_for(&attachment, held)
        });
        self.place = place.unwrap_or(self.place);
        place.is_some()
    }

    /// The things that are held, each with its number, in the world, by the pose in the space of the model; those of bones that are
    /// not there are left out.
    pub fn things<'a>(&'a self, model_pose: &'a [Affine3A]) -> impl Iterator<Item = (usize, Affine3A)> + 'a {
        let place = self.place.to_affine();
        self.things
            .iter()
            .enumerate()
            .filter_map(move |(number, (bone, grip))| Some((number, place * attached(model_pose.get(*bone)?, grip))))
    }
}

/// The layer of a frame that [`Instance::layer`] makes.
#[derive(Debug)]
pub struct InstanceLayer<'a> {
    instance: &'a mut Instance,
    model: &'a Model,
}

impl Layer for InstanceLayer<'_> {
    fn apply(&mut self, figure: &mut Figure, _dt_s: f32) -> Result<(), PoseError> {
        figure.place = self.instance.place;
        figure.edit(|local| self.instance.pose(self.model, local))
    }
}

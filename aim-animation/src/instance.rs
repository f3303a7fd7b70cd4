//! [`Instance`]: one character with its place, the clips that it plays and the objects that it holds.

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

/// A clip played by an [`Instance`], with its playback state, weight and mask.
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
    /// Index of the clip in the [`Model`].
    pub clip: usize,
    /// Local time, speed, looping.
    pub control: Control,
    /// Weight relative to the other clips, 0…1; NaN is treated as 0. At 0 the clip still advances, but is not sampled.
    pub weight: f32,
    /// Index of a mask of the model, which multiplies the weight of each bone; `None` for no mask. If the model has no
    /// such mask, the weight is 0 for every bone.
    pub mask: Option<usize>,
}

impl ClipControl {
    /// Plays a clip from its beginning, at speed 1, repeating, with weight 1 for all bones.
    #[must_use]
    pub const fn new(clip: usize) -> Self {
        Self { clip, control: Control::new(), weight: 1.0, mask: None }
    }

    /// Sets the playback state: local time, speed and looping.
    #[must_use]
    pub const fn with_control(mut self, control: Control) -> Self {
        self.control = control;
        self
    }

    /// Sets the [`weight`](Self::weight).
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }

    /// Sets the mask, as an index into the masks of the model.
    #[must_use]
    pub const fn with_mask(mut self, mask: usize) -> Self {
        self.mask = Some(mask);
        self
    }

    /// Returns the weight of a bone: clip weight times mask weight.
    fn weight_of(&self, model: &Model, bone: usize) -> f32 {
        let mask = self.mask.map_or(1.0, |mask| {
            let mask = model.masks().get(mask).and_then(|mask| mask.weights().get(bone));
            mask.copied().unwrap_or(0.0)
        });
        clamped(self.weight) * mask
    }
}

/// One character: its place, the clips that it plays, and the objects that it holds.
///
/// [`advance`](Self::advance) advances all clips by one frame and moves the place by their root motion, without
/// evaluating a pose. [`pose`](Self::pose) evaluates the weighted mean of the clips: two clips of weight 1 contribute
/// half each. Bones that a clip has no tracks for are at rest in it.
///
/// For override layers, blend spaces and additive clips, use a [`Tree`](crate::Tree) with its own
/// [`Scratch`](crate::Scratch) memory, and sample its sources at the local times in [`steps`](Self::steps).
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
    /// The character's transform from model to world space, without scale.
    pub place: Transform,
    controls: Vec<ClipControl>,
    /// One cursor for each control.
    cursors: Vec<Cursor>,
    /// Copy of the model's initial cursor, cloned for each clip that is played.
    cursor: Cursor,
    steps: Vec<Step>,
    /// Bone of each held object, and the transform of the object in bone space.
    things: Vec<(usize, Affine3A)>,
    scratch: Vec<Transform>,
    sums: Vec<BoneSum>,
}

impl Instance {
    /// Creates a character at the origin that plays no clips.
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

    /// Adds a clip to those played, and returns its index in [`controls`](Self::controls).
    pub fn play(&mut self, control: ClipControl) -> usize {
        self.controls.push(control);
        self.cursors.push(self.cursor.clone());
        self.steps.push(Step::none(0.0, 0.0));
        self.controls.len() - 1
    }

    /// Stops a clip. The indices of later controls decrease by one. Does nothing if there is no such control.
    pub fn stop(&mut self, control: usize) {
        if control < self.controls.len() {
            self.controls.remove(control);
            self.cursors.remove(control);
            self.steps.remove(control);
        }
    }

    /// Returns the clips being played.
    #[must_use]
    pub fn controls(&self) -> &[ClipControl] {
        &self.controls
    }

    /// Returns the clips being played, to change their weights, speeds and times.
    pub fn controls_mut(&mut self) -> &mut [ClipControl] {
        &mut self.controls
    }

    /// Returns the step that each clip took in the last [`advance`](Self::advance), in the order of
    /// [`controls`](Self::controls).
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Attaches an object to a bone, and returns its index in [`things`](Self::things). `grip` is the object's
    /// transform in bone space.
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

    /// Detaches an object. The indices of later objects decrease by one. Does nothing if there is no such object.
    pub fn detach(&mut self, thing: usize) {
        if thing < self.things.len() {
            self.things.remove(thing);
        }
    }

    /// Advances every clip by `dt_s` seconds, and moves the place by their root motion. Does not allocate.
    ///
    /// The root motion is the [weighted mean](Motion::blend) of the clips, with the weight of each clip for the root
    /// bone. A clip without root motion contributes no movement at its weight, and so slows the others down. To avoid
    /// that, mask out the root bone in that clip.
    pub fn advance(&mut self, model: &Model, dt_s: f32) {
        for (playing, step) in self.controls.iter_mut().zip(&mut self.steps) {
            let length = model.playable_clip(playing.clip).map_or(0.0, |clip| clip.length_s());
            *step = playing.control.advance(dt_s, length);
        }
        let deltas = self.controls.iter().zip(&self.steps).map(|(playing, step)| {
            let delta = model.motion(playing.clip).map_or(Transform::IDENTITY, |motion| motion.delta(step));
            let is_clip = model.playable_clip(playing.clip).is_some();
            (delta, if is_clip { playing.weight_of(model, model.root_bone(playing.clip)) } else { 0.0 })
        });
        self.place = self.place.rigid_product(&Motion::blend(deltas));
    }

    /// Returns the events passed in the last [`advance`](Self::advance), each with the index of its control: control by
    /// control, and in the order passed within each.
    ///
    /// Clips of weight 0 report events too, since they still advance. Use the index to look up the weight.
    pub fn events<'a, 'm>(&'a self, model: &'m Model) -> impl Iterator<Item = (usize, &'m Event)> + use<'a, 'm> {
        self.controls.iter().zip(&self.steps).enumerate().flat_map(move |(number, (playing, step))| {
            let clip = model.playable_clip(playing.clip);
            clip.into_iter().flat_map(|clip| events_passed(clip.events(), step)).map(move |event| (number, event))
        })
    }

    /// Writes the local pose, without the root motion, which is in the place. Does not allocate.
    ///
    /// Each bone is the weighted mean of the clips, Σ wᵢ·poseᵢ / Σ wᵢ, as in [`Blender::sum`](crate::Blender::sum).
    /// Bones without any weight are at rest.
    ///
    /// # Errors
    /// Fails if `local` differs in length from the skeleton, or if the instance was made for a model with another
    /// number of bones. Nothing is written then.
    pub fn pose(&mut self, model: &Model, local: &mut [Transform]) -> Result<(), PoseError> {
        let (skeleton, method) = (model.skeleton(), Method::Nlerp);
        check_length(skeleton.len(), local.len())?;
        check_length(skeleton.len(), self.scratch.len())?;
        self.sums.fill(BoneSum::ZERO);
        for (playing, cursor) in self.controls.iter().zip(&mut self.cursors) {
            let Some(clip) = model.playable_clip(playing.clip).filter(|_| playing.weight > 0.0) else { continue };
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

    /// Returns a layer that writes the place and the pose of this instance to a [`Figure`]. Call
    /// [`advance`](Self::advance) before, and run it as the figure's first layer.
    pub fn layer<'a>(&'a mut self, model: &'a Model) -> InstanceLayer<'a> {
        InstanceLayer { instance: self, model }
    }

    /// Moves the place so that a held object coincides with `held`, world space: see [`Figure::hang`].
    ///
    /// `model_pose` is the current pose in model space. Returns `false` and changes nothing if there is no such object
    /// or bone, or if the result is not finite.
    pub fn hang(&mut self, thing: usize, model_pose: &[Affine3A], held: &Affine3A) -> bool {
        let place = self.things.get(thing).and_then(|(bone, grip)| {
            let attachment = attached(model_pose.get(*bone)?, grip);
            place_for(&attachment, held)
        });
        self.place = place.unwrap_or(self.place);
        place.is_some()
    }

    /// Returns the index and the world transform of each held object.
    ///
    /// `model_pose` is the current pose in model space. Objects of bones past its end are skipped.
    pub fn things<'a>(&'a self, model_pose: &'a [Affine3A]) -> impl Iterator<Item = (usize, Affine3A)> + 'a {
        let place = self.place.to_affine();
        self.things
            .iter()
            .enumerate()
            .filter_map(move |(number, (bone, grip))| Some((number, place * attached(model_pose.get(*bone)?, grip))))
    }
}

/// Layer that writes the place and the pose of an [`Instance`] to a [`Figure`]; see [`Instance::layer`].
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

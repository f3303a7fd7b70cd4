//! Eyes that look by morph targets: weights of the targets, and the directions of gaze that they give.

use core::ops::Range;
use std::collections::BTreeMap;

use aim_animation::{Clip, Transform};
use aim_gltf::{Document, MorphBind, MorphEye};

use crate::bake::chain::ChainNodes;
use crate::measure::{BoneFrame, Measurement};
use crate::num;

/// The eyes of a chain that look by morph targets.
#[derive(Debug, Clone)]
pub(crate) struct MorphEyes {
    /// Each eye, with the axes of its node.
    eyes: Vec<(MorphEye, BoneFrame)>,
    /// For each node that shows the eyes, the weights without a clip and the indices of its scalars.
    at_rest: BTreeMap<usize, (Vec<f32>, Range<usize>)>,
}

impl MorphEyes {
    pub(crate) fn find(document: &Document, measurement: &Measurement, chain: &ChainNodes) -> Self {
        let skeleton = document.skeleton();
        let is_turned = |eye: &&MorphEye| chain.turned().any(|node| node == eye.node);
        let eyes = skeleton.morph_eyes().iter().filter(is_turned);
        let eyes: Vec<_> = eyes.filter_map(|eye| Some((eye.clone(), measurement.bone(eye.node)?.frame))).collect();
        let binds = eyes.iter().flat_map(|(eye, _)| eye.ways.iter().flat_map(|way| &way.binds));
        let at_rest = binds.filter_map(|bind| {
            Some((bind.node, (skeleton.morph_weights(bind.node)?.to_vec(), document.morph_scalars(bind.node))))
        });
        Self { at_rest: at_rest.collect(), eyes }
    }

    /// Returns the nodes whose weights the eyes set.
    fn nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.at_rest.keys().copied()
    }

    /// Returns the indices of the scalars that the eyes set.
    pub(crate) fn scalars(&self) -> impl Iterator<Item = usize> + '_ {
        self.at_rest.values().flat_map(|(_, scalars)| scalars.clone())
    }

    /// Turns each eye to the direction that the weights at a time of a clip give.
    pub(crate) fn pose(&self, clip: Option<&Clip>, seconds: f32, pose: &mut [Transform]) {
        for (eye, frame) in &self.eyes {
            let angles = angles(eye, |bind| f64::from(self.weights(clip, seconds, bind.node)[bind.target]));
            if let Some(node) = pose.get_mut(eye.node) {
                node.rotation = frame.turn(angles).as_quat();
            }
        }
    }

    /// Returns the weights of the [scalars](Self::scalars), in their order: those of the clip, changed by the rotation
    /// of the eyes in `pose` since then. The change takes no weight out of 0…1.
    pub(crate) fn aimed(&self, clip: Option<&Clip>, seconds: f32, pose: &[Transform]) -> Vec<f32> {
        let animated: BTreeMap<usize, Vec<f32>> =
            self.nodes().map(|node| (node, self.weights(clip, seconds, node))).collect();
        let mut aimed = animated.clone();
        for (eye, frame) in &self.eyes {
            let before = angles(eye, |bind| f64::from(animated[&bind.node][bind.target]));
            let Some(node) = pose.get(eye.node) else { continue };
            let after = frame.angles(node.rotation.as_dquat());
            for ((way, before), after) in eye.ways.iter().zip(weights(eye, before)).zip(weights(eye, after)) {
                for bind in &way.binds {
                    let was = animated[&bind.node][bind.target];
                    if let Some(weight) = aimed.get_mut(&bind.node).and_then(|of| of.get_mut(bind.target)) {
                        let changed = *weight + num::narrow(bind.weight * (after - before));
                        *weight = changed.clamp(was.min(0.0), was.max(1.0));
                    }
                }
            }
        }
        aimed.into_values().flatten().collect()
    }

    /// Returns all weights of a node at a time of a clip.
    fn weights(&self, clip: Option<&Clip>, seconds: f32, node: usize) -> Vec<f32> {
        let (at_rest, scalars) = &self.at_rest[&node];
        let mut weights = at_rest.clone();
        for (scalar, track) in clip.into_iter().flat_map(Clip::scalars).filter(|(scalar, _)| scalars.contains(scalar)) {
            weights[scalar - scalars.start] = track.sample(seconds);
        }
        weights
    }
}

/// Returns the weights, 0…1, of looking right, left, down and up at a heading and a pitch in radians.
fn weights(eye: &MorphEye, [heading, pitch]: [f64; 2]) -> [f64; 4] {
    let ways = [-heading, heading, -pitch, pitch].map(f64::to_degrees);
    core::array::from_fn(|at| eye.ways[at].map.apply(ways[at]).min(1.0))
}

/// Returns the heading and pitch, radians, that the weights give: angle to the left less angle to the right, angle up
/// less angle down.
fn angles(eye: &MorphEye, weight: impl Fn(&MorphBind) -> f64) -> [f64; 2] {
    let [right, left, down, up] = eye.ways.each_ref().map(|way| {
        let of_expression = way.binds.first().map_or(0.0, |bind| weight(bind) / bind.weight);
        way.map.input(of_expression.min(1.0)).to_radians()
    });
    [left - right, up - down]
}

/**
 * Gaze in react-three-fiber: a hook for characters of three.js and VRM avatars.
 *
 * @module
 */
import { useFrame } from "@react-three/fiber";
import { useEffect, useRef, useState } from "react";
import type { RefObject } from "react";
import type { VRMCore } from "@pixiv/three-vrm";

import type { AttachOptions, Gaze } from "./index.js";
import { attach as attachObject } from "./three.js";
import type { Target } from "./three.js";
import { attach as attachVrm } from "./three-vrm.js";

export type { Target } from "./three.js";

/** What can be attached: an object of three.js, a glTF as `useGLTF` or `useLoader` gives it, or a VRM. */
export type Source = Parameters<typeof attachObject>[0] | VRMCore;

export interface GazeOptions extends Omit<AttachOptions<Target>, "target"> {
  /** What to look at; also as a ref, which is looked up each frame. */
  readonly target?: Target | RefObject<Target | null> | null;
  /**
   * When to run among the frame's other callbacks: less is earlier. It must be after the animation and, for a VRM, before
   * `vrm.update`; within one component hooks run in the order in which they are called. Above 0 react-three-fiber leaves rendering
   * to you.
   */
  readonly priority?: number;
}

interface Attached {
  readonly gaze: Gaze<Target>;
  readonly source: Source;
}

/**
 * Makes a character look at targets while the component is mounted; `null` until it is ready. `source` may be missing while it loads.
 *
 * Attaches anew when the source, `rig` or `bothEyes` changes. Other options are set on the gaze where they change, so that they may as
 * well be left out and set on the gaze by hand. What attaching throws is thrown in rendering, for an error boundary.
 */
export function useGaze(source: Source | null | undefined, options: GazeOptions = {}): Gaze<Target> | null {
  const [attached, setAttached] = useState<Attached | null>(null);
  const [failed, setFailed] = useState<{ readonly error: unknown; readonly source: Source } | null>(null);
  /** What runs each frame. Not the state: that outlives the gaze until the next rendering. */
  const running = useRef<Gaze<Target> | null>(null);
  const latest = useRef(options);
  useEffect(() => {
    latest.current = options;
  });

  const rig = contentOf(options.rig);
  useEffect(() => {
    if (!source) return;
    let gaze: Gaze<Target> | null = null;
    let gone = false;
    setFailed(null);
    attachAny(source, latest.current).then(
      (made) => {
        if (gone) {
          made.dispose();
          return;
        }
        gaze = made;
        running.current = made;
        setAttached({ gaze: made, source });
      },
      (error: unknown) => {
        if (!gone) setFailed({ error, source });
      },
    );
    return () => {
      gone = true;
      if (running.current === gaze) running.current = null;
      gaze?.dispose();
      setAttached(null);
    };
  }, [source, rig, options.bothEyes]);

  const gaze = attached && attached.source === source ? attached.gaze : null;
  const { target, targets, weight, attention, patience, tolerance, behind } = options;
  // Where an option changes, and at first: they may have changed since attaching began.
  useEffect(() => {
    if (running.current && running.current === gaze && target !== undefined) gaze.target = pointOf(target);
  }, [gaze, target]);
  useEffect(() => {
    if (running.current && running.current === gaze && targets !== undefined) gaze.targets = targets;
  }, [gaze, targets]);
  useEffect(() => {
    if (!running.current || running.current !== gaze) return;
    if (weight !== undefined) gaze.weight = weight;
    if (attention !== undefined) gaze.attention = attention;
    if (patience !== undefined) gaze.patience = patience;
    if (tolerance !== undefined) gaze.tolerance = tolerance;
    if (behind !== undefined) gaze.behind = behind;
  }, [gaze, weight, attention, patience, tolerance, behind]);

  useFrame((_, delta) => {
    const { current } = running;
    if (!current) return;
    const { target } = latest.current;
    if (isRef(target) && current.target !== target.current) current.target = target.current;
    current.update(delta);
  }, options.priority);

  if (failed && failed.source === source) throw failed.error;
  return gaze;
}

async function attachAny(source: Source, { target, priority: _, ...options }: GazeOptions): Promise<Gaze<Target>> {
  const given = target === undefined ? options : { ...options, target: pointOf(target) };
  return await ("humanoid" in source ? attachVrm(source, given) : attachObject(source, given));
}

/** What tells one rig from another, so that a rig that is written out in rendering is not another one each time. */
function contentOf(rig: GazeOptions["rig"]): unknown {
  if (typeof rig !== "object") return rig;
  return "toml" in rig ? rig.toml : rig.glb;
}

function isRef(target: GazeOptions["target"]): target is RefObject<Target | null> {
  return typeof target === "object" && target !== null && "current" in target;
}

function pointOf(target: Target | RefObject<Target | null> | null): Target | null {
  return isRef(target) ? target.current : target;
}

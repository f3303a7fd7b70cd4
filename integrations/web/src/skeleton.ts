/** The numbers of a local transform: translation, rotation, scale. */
export const LOCAL = 10;

/**
 * A skeleton as an engine holds it: what adapters make.
 */
export interface Skeleton {
  /** The bones, in any order. */
  readonly bones: readonly Bone[];
  /**
   * The local transform of a bone as it is now: translation x y z, rotation x y z w, scale x y z, written into `into` from `offset` on.
   * Called each frame, for the bones that matter.
   */
  read(bone: number, into: Float32Array, offset: number): void;
  /** Sets the local translation and rotation of a bone to the seven numbers from `offset` on. */
  write(bone: number, from: Float32Array, offset: number): void;
  /** The world matrix in this frame, sixteen numbers, column by column, of what the root bones hang on. */
  place(into: Float32Array, offset: number): void;
  /** What stands for a bone in the engine: by it two gazes on one bone are told of. */
  key?(bone: number): object | undefined;
  /** Called when a frame begins, before anything is read. */
  begin?(): void;
  /** Called when a frame ends, after everything is written. */
  end?(): void;
  /** Called when the gaze is disposed of, after the bones have been put back. */
  dispose?(): void;
}

/** A bone of a {@link Skeleton}. */
export interface Bone {
  /** Its name; presets and rig files find bones by it. */
  readonly name: string;
  /** The index of the bone that it hangs on; −1 of a root. */
  readonly parent: number;
  /** Its local transform at rest, ten numbers as {@link Skeleton.read} gives them; without it, the one that it has when attached. */
  readonly rest?: ArrayLike<number>;
  /** The inverse bind matrix of a skin, sixteen numbers, column by column, from the character's space to the bone's. */
  readonly inverseBind?: ArrayLike<number>;
  /** The index of its node in the glTF file that it comes from. */
  readonly node?: number;
}

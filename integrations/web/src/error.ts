/** The error that this package throws: its message says what was expected and what to do. */
export class GazeError extends Error {
  override readonly name = "GazeError";
}

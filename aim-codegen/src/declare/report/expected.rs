//! [`Expected`]: the expected form of a setting's value.

use crate::declare::tree::Notation;

/// Expected form of a value, in words, and an example of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expected {
    pub(crate) form: Form,
    pub(crate) words: &'static str,
    /// A whole setting in Rust and in TOML, with `KEY` for its key.
    examples: [&'static str; 2],
}

/// Form of an expected value; decides the help for a value of the wrong form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// A number with a unit, or two of them.
    Angle,
    /// A bare word, in quotes in TOML.
    Word,
    /// A string that is meant as a string.
    Text,
    /// No value: the key stands alone.
    Nothing,
    /// Anything else.
    Other,
}

impl Expected {
    /// Returns an example of a whole setting, in this notation.
    pub(crate) fn example(self, key: &str, notation: Notation) -> String {
        let [rust, toml] = self.examples;
        notation.pick(rust, toml).replace("KEY", key)
    }
}

/// Defines constants: `NAME: form, words, [example in Rust, example in TOML];`
macro_rules! expected {
    ($($name:ident: $form:ident, $words:literal, $examples:expr;)*) => {
        impl Expected {
            $(pub(crate) const $name: Self = Self { form: Form::$form, words: $words, examples: $examples };)*
        }
    };
}

expected! {
    ANGLE: Angle, "an angle", ["KEY = -35deg", "KEY = \"-35deg\""];
    ANGLE_RANGE: Angle, "a range of angles", RANGE;
    HEADING_RANGE: Angle, "a range of angles or `free`", RANGE;
    RATE: Angle, "an angle per second", ["KEY = 450deg", "KEY = \"450deg\""];
    ACCELERATION: Angle, "an angle per second²", ["KEY = 1200deg", "KEY = \"1200deg\""];
    NUMBER: Other, "a plain number", ["KEY = 0.5"; 2];
    SECONDS: Other, "a number of seconds", ["KEY = 0.05"; 2];
    DIRECTION: Other, "a signed axis or a vector", ["KEY = +Y", "KEY = \"+Y\""];
    POINT: Other, "a vector", ["KEY = (0.0, 0.1, 0.0)", "KEY = [0.0, 0.1, 0.0]"];
    AXES: Other, "two or three axes", ["KEY(up = +X, forward = +Y)", "KEY = { up = \"+X\", forward = \"+Y\" }"];
    EFFECTOR: Other, "`forward`, `origin` or both", ["KEY(origin = (0.0, 0.1, 0.0))", "KEY = { origin = [0.0, 0.1, 0.0] }"];
    NATURAL: Other, "settings such as `eyes_only`", ["KEY(eyes_only = 15deg)", "KEY = { eyes_only = \"15deg\" }"];
    REGION: Other, "a kind of body or budgets of `head` and `chest`", ["KEY = human", "KEY = \"human\""];
    BODY: Word, "`human`, `quadruped`, `bird` or `toon`", ["KEY = human", "KEY = \"human\""];
    BUDGET: Other, "settings such as `heading` and `rate`", ["KEY(rate = 240deg)", "KEY = { rate = \"240deg\" }"];
    KERNELS: Word, "a list of kernels", ["KEY(aim_gradient)", "KEY = [\"aim_gradient\"]"];
    FLAG: Word, "`true` or `false`", ["KEY = true"; 2];
    SIDE: Word, "`left` or `right`", ["KEY = left", "KEY = \"left\""];
    LIMITS_FROM: Word, "`animation` or `bind_pose`", ["KEY = bind_pose", "KEY = \"bind_pose\""];
    ROLE: Word, "`eye`, `head`, `neck`, `chest` or `none`", ["KEY = eye", "KEY = \"eye\""];
    NODE_NAME: Text, "a node's name", ["KEY = \"L_eye\""; 2];
    NODE_NAMES: Text, "a node's name or a list of names", ["KEY = \"L_eye\""; 2];
    HELD_NAMES: Text, "a list of nodes' names", ["KEY = [\"clavicle_l\", \"clavicle_r\"]"; 2];
    NAME: Text, "a name", ["KEY = \"left_eye\""; 2];
    PATH: Other, "a path", ["KEY = ::aim"; 2];
    JOINTS: Other, "a list of joints", ["[[KEY]]"; 2];
    // Settings of `#[differentiate]`.
    ARGUMENTS: Word, "the names of arguments", ["KEY(p, h)"; 2];
    LENGTHS: Other, "the lengths of slices", ["KEY(values = 8)"; 2];
    OPERATIONS: Other, "a whole number of operations", ["KEY = 46"; 2];
    SELECTS: Other, "a whole number of comparisons and selects", ["KEY = 2"; 2];
    CALLS: Other, "a whole number of calls", ["KEY = 4"; 2];
    PRESENCE: Nothing, "no value", ["KEY"; 2];
}

const RANGE: [&str; 2] = ["KEY = -35deg..=35deg", "KEY = [\"-35deg\", \"35deg\"]"];

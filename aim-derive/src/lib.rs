//! The macros of `aim-rig`: hand their tokens to `aim-codegen` and what comes back to the compiler.

use proc_macro::TokenStream;

/// Derives a rig: `Rig`, with kernels for exactly the declared axes, and `AimRig`.
///
/// On the struct, `#[aim(axes(up = +X, forward = +Y, left = +Z), handedness = right, effector(forward = +Y,
/// origin = (0.0, 0.1, 0.0)), natural(…), region = human, crate = ::aim)]`; two of the three axes are enough. On each field,
/// from the eye inward, `#[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]` with at least
/// one of the angles and the rate, the largest speed of each angle. A joint may also have:
///
/// | setting | meaning |
/// |---|---|
/// | `role = eye` | what the joint is: `eye`, `head`, `neck`, `chest` (any joint of the upper torso) or `none`, the default |
/// | `axes(…)` | this bone's own axes |
/// | `mirrored = true` | its axes are mirrored |
/// | `heading = free` | a turret: no limit |
/// | `stiffness = 4.0` | weight in the displacement cost: stiffer joints move less; 1 by default |
/// | `acceleration = 1200deg` | largest change of speed, per second squared |
/// | `upright = 0.5` | how far heading turns about the character's up, 0 to 1 |
/// | `pitch_taper = 0.3` | the part of the pitch's range that is lost at the ends of the heading's, growing from 0 at heading 0; 0 to 1 |
/// | `limits_from = bind_pose` | ranges are counted from the bind pose, not from the animation |
/// | `bone = "node"` or `["a", "b"]` | its names in models; the field's name by default |
/// | `other_eye = "node"` | on the eye: the other eye |
/// | `hold = ["a", "b"]` | bones that hang on this joint and stay with what carries it, as clavicles on a neck; see `Description::held_correction` |
///
/// # How a natural gaze is shared
///
/// `natural(eyes_only = 15deg, head_share = 0.8, engage = 15deg, release = 8deg, delay = 0)` says how eyes, neck and spine
/// share a gaze in the natural solver; what is left out is as written here. `eyes_only` is the shift that the eyes make
/// alone, `head_share` the head's part of what is beyond it (0 to 1); the head begins to help when the eyes are further
/// than `engage` from their middle, rests again nearer than `release`, and begins `delay` seconds after the eyes.
///
/// The part a joint has in the gaze is its `role`; names tell nothing. Neck and head turn about the character's up unless
/// `upright` says otherwise, and a rig with a joint that has a role is aimed by the natural solver unless a call asks for
/// another.
///
/// # What the body can do
///
/// `region = human` (the default), `quadruped`, `bird` or `toon` says what the parts of the body can do together in the natural
/// solver, the animation's own turn included; `region(like = bird, head(heading = -130deg..=130deg, pitch = -70deg..=70deg,
/// rate = 400deg, acceleration = 4000deg), chest(…))` says it in numbers, and what is left out is as of `like`. The head is
/// the joints with the roles `head` and `neck`, the chest those with the role `chest`.
///
/// # A pose by name, and further kernels
///
/// Beside the traits there is a struct of the rig's visibility, `HeroPose` for `Hero`, with a field for each joint: for poses
/// and corrections that are given and read by name. It is converted from and to an array of the joints' values.
///
/// `kernels(aim_gradient, chain_value_gradient, chain_residual_jacobian)` on the struct, with any of the three, makes
/// associated functions of those names, generic over `Scalar`: `Hero::chain_value_gradient(links, target, sin_cos, out)`.
#[proc_macro_derive(AimRig, attributes(aim, joint))]
pub fn derive_aim_rig(input: TokenStream) -> TokenStream {
    aim_codegen::derive(input.into()).into()
}

/// Differentiates a function, or functions of a module: beside each appears one that gives its value and its derivatives, as
/// straight-line code derived while compiling.
///
/// ```ignore
/// #[differentiate(wrt(p, h), budget = 46)]
/// fn aim(p: f32, h: f32, eye: Rigid, target: Vec3) -> f32 {
///     let turn = Quat::from_rotation_x(h) * Quat::from_rotation_z(p);
///     let to_target = target - turn * Vec3::from(eye.translation);
///     (turn * Vec3::from(eye.matrix3.y_axis)).dot(to_target.normalize())
/// }
///
/// let (value, (by_p, by_h)) = aim_gradient(p, h, eye, target);
/// ```
///
/// The function itself stays as it is written. Its companions have its arguments and its visibility:
///
/// | companion | of | returns |
/// |---|---|---|
/// | `…_gradient` | a number | the value and a tuple of derivatives in the order of `wrt`, each of its argument's own type |
/// | `…_jacobian` | a vector | the value and a tuple: by a number a vector; of a `Vec3` by a `Vec3` the matrix whose columns are the derivatives by the components (`Mat3`, `DMat3`); by anything else an array of vectors, one a component of the argument |
/// | `…_jacobian` | several numbers: an array, a tuple, a struct, a quaternion, a matrix | the value and a tuple of arrays of **rows**: one row a number of the result, each the gradient of that number, of the argument's own type |
/// | `…_hessian`, with `hessian` | a number | the value, the tuple, and `[[f32; n]; n]` over the variables' components |
/// | `…_jvp`, with `jvp` | anything | the value, and its derivative along a direction: further arguments `along_p` for each variable `p` |
/// | `…_vjp`, with `vjp` | anything | the value, and the tuple of derivatives of its numbers' sum, each times its part of a further argument `weights` |
/// | `…_hvp`, with `hvp` | a number | the derivative along a direction, as for `jvp`, and the Hessian times that direction, as a tuple |
/// | `…_gauss_newton`, with `gauss_newton` | residuals r, anything | `r`, the tuple `Jᵀr`, and `JᵀJ` over the variables' components: the normal equations of least squares |
///
/// The numbers of a value are in the order of its parts: elements and fields as declared, `x y z w`, matrices column by column.
///
/// # Modules
///
/// On a module in braces the attribute shows its functions what stands beside them, also in modules inside of it: constants,
/// structs with their methods, operators and other traits, type aliases, and functions, which are inlined. Those that have the attribute themselves get companions:
///
/// ```ignore
/// #[differentiate(check = true)]
/// mod fit {
///     const WIDTH: f64 = 0.5;
///
///     fn robust(r: f64) -> f64 {
///         if r.abs() < WIDTH {
///             return 0.5 * r * r;
///         }
///         WIDTH * (r.abs() - 0.5 * WIDTH)
///     }
///
///     #[differentiate(wrt(line))]
///     pub fn cost(line: [f64; 2], points: &[[f64; 2]; 4]) -> f64 {
///         let mut sum = 0.0;
///         for [x, y] in points {
///             sum += robust(line[0] * x + line[1] - y);
///         }
///         sum
///     }
/// }
///
/// let (cost, (by_line,)) = fit::cost_gradient([1.0, 0.0], &points);
/// ```
///
/// # Options
///
/// | option | meaning |
/// |---|---|
/// | `wrt(p, h)` | the arguments to differentiate by; needed |
/// | `wrt(tangent(q), p)` | `q` is a rotation or a transform, and derivatives by it are on its manifold: see below |
/// | `perturbation = left` | the side of these derivatives; `right` by default |
/// | `lengths(values = 8)` | how many elements the companions take of arguments that are slices: `&[f64; 8]` of a `&[f64]` |
/// | `budget = 46` | more operations than that in the gradient or Jacobian, a round of each loop that stays one included, are a compile error that tells the counts (additions, multiplications, divisions and roots) |
/// | `budget(operations = 46, selects = 2, calls = 4)` | the same for each kind; `selects` are the comparisons and selects of `if`, `min`, `abs` and guards, two an `if` of one comparison between numbers, `calls` the sines and other functions; any may be left out |
/// | `hessian`, `jvp`, `vjp`, `hvp`, `gauss_newton` | these companions, too: products cost a few times what the function does, however many variables there are |
/// | `lanes` | beside each companion another, `…_gradient_lanes` and so on, generic over [`Real`](https://docs.rs/aim-rig/latest/aim/trait.Real.html): see below |
/// | `check = true` | a test beside the function compares its first derivatives with central differences at random points, where the function has a slope there and does not panic; also of a module, for all of its functions |
/// | `crate = path` | the path of `aim`, where it is not `::aim`; also of a module |
///
/// # Lanes
///
/// With `lanes` a companion is there a second time, for numbers of any type that implements `Real`: with the feature `wide` a vector of
/// numbers, a point a lane. Each lane has the bits that the companion gives at its point. Arguments and results are made of these
/// numbers:
///
/// | a value of | in lanes |
/// |---|---|
/// | a number, a whole number, a `bool` | one number; of `true` 1, of `false` 0 |
/// | a vector, a quaternion, a matrix, a transform | the array of its numbers, and derivatives as of an array |
/// | an array, a tuple | of its elements in lanes |
/// | a struct | the tuple of its fields in lanes |
/// | an enum | the tuple of its variant's number, from 0, and of the fields of all variants |
///
/// ```ignore
/// #[differentiate(wrt(p), lanes)]
/// fn energy(p: Vec3, springs: &[Spring; 4]) -> f32 {
///     /* as it stands */
/// }
///
/// let (value, ([by_x, by_y, by_z],)) = energy_gradient_lanes([x, y, z], &springs); // f32x8
/// ```
///
/// # The language
///
/// | | understood | not |
/// |---|---|---|
/// | arguments | `f32 Vec2 Vec3 Vec3A Vec4 Quat Mat2 Mat3 Mat3A Mat4 Rigid Affine3A` or `f64 DVec2 DVec3 DVec4 DQuat DMat2 DMat3 DMat4 DRigid DAffine3`, one number type a function; `bool` and integers, which do not vary; `&[T]`, also as a field of a struct; arrays, tuples, structs and enums of the module and `Option` of these; by value or by `&`; known by the last words of their types | derivatives by slices, unless `lengths` says how long they are; `Vec` |
/// | results | numbers, vectors, quaternions, matrices, transforms; arrays, tuples and structs of these; `Option` and `Result` of these, of which companions return an `Option` | `Vec`, enums, whole numbers |
/// | statements | `let`, `let mut`, `const`, blocks, `=`, `+=` and its like to variables, fields and elements, `return`, `&mut` of variables and parts of them, `debug_assert!` (which companions leave out) | `&mut` arguments of the function itself |
/// | patterns | names, `_`, tuples, arrays with `..`, structs, variants, `Some` and `None`, numbers, ranges, `\|`, guards | `@`, `ref` |
/// | branches | `if`, `if let`, `let … else`, `match`, `matches!`, with `&&`, `\|\|`, `!`: both sides are computed, and selected; `?` of `Option` and `Result`; what is right of `&&` and `\|\|` has effects only where it is reached | what an `Err` says |
/// | loops | `for` over ranges, arrays, slices and their iterators, `while` and `loop`, with `break`, also of a value, `continue` and labels: written out, up to 10 000 rounds and 20 000 operations a function; those of which no end is known, as over slices, to `n` or until something has converged, stay loops and carry derivatives from round to round | other companions than the gradient or Jacobian, and lanes, of functions with them |
/// | of arrays | `len first last map swap fill reverse sort_by iter iter_mut last_mut split_at_mut windows chunks chunks_mut`, parts as in `&mut v[1..4]`, `array::from_fn`; of iterators `enumerate zip chain rev skip take step_by map flat_map filter filter_map take_while scan` and their like, `sum product fold reduce min_by max_by any all find position count`; a local `Vec`, of which arguments may decide what elements there are: `vec! push pop insert remove retain extend truncate collect`; slices. An element that an argument chooses is a select among all; of an index outside, where the function panics, it is the first or the last | arrays of more than 16 to be sorted, windows of a list whose length arguments decide |
/// | functions | those of the module, methods and operators that it implements for its structs and enums, functions inside of the function, closures, `f64::sin` and its like as arguments; recursion of a depth that is known, up to 16, or that the branches on the way end; generic functions, structs and enums, whose parameters the values tell | closures that change what is outside, passed to other functions; generic traits |
/// | whole numbers | `+ - * / %`, comparisons, `as` from and to numbers | what wraps round, bits |
///
/// - `Rigid` and `Affine3A` count as **rigid**, a rotation and a translation: the derivation relies on it. Derivatives by
///   them are by their tangents.
/// - A `Quat` that is not in `wrt`, or there as `tangent(q)`, counts as of length 1. One that is there as `q` is four
///   numbers: its derivatives are those of glam's own formula, off the unit sphere too.
/// - A `Mat3` is any matrix, unless it is in `wrt` as `tangent(m)`.
/// - Derivatives by a struct, an enum or an option are of the same type; what does not vary in it is as in the argument.
///
/// Of the methods of numbers and of glam's types there are
///
/// - of numbers: `sin cos sin_cos tan asin acos atan atan2 sinh cosh tanh sqrt cbrt exp exp2 ln log log2 log10 powi powf
///   abs signum copysign min max clamp recip mul_add hypot rem_euclid to_radians to_degrees`, `%`, and `core::f32::consts`;
///   `powf` by a constant multiple of ½ is made of products and roots
/// - of vectors: swizzles, `dot cross length length_squared length_recip distance distance_squared normalize
///   normalize_or_zero lerp midpoint project_onto reject_from reflect angle_between clamp_length abs min max clamp mul_add
///   with_x truncate extend perp perp_dot to_angle angle_to rotate rotate_x` and a few more; `Vec3::X`, `Vec3::ZERO` and their like
/// - of quaternions and matrices: `from_rotation_x`, `from_axis_angle`, `from_euler`, `from_quat`, `from_mat3`,
///   `from_cols`, `from_scaled_axis`, `to_scaled_axis`, `to_axis_angle`, `inverse`, `conjugate`, `transpose`, `determinant`, `normalize`, `slerp`, `mul_vec3`, …
/// - of transforms, and of `Mat4` alike, `project_point3` too: `from_rotation_translation`, `transform_point3`, `transform_vector3`, `inverse`, …
///
/// Anything else is a compile error where it stands, with what to write instead.
///
/// # Variables on their manifold
///
/// The numbers of a rotation depend on each other; an optimiser that moves them one by one leaves the rotations. With
/// `wrt(tangent(q))` derivatives are by the tangent vector δ of a small further turn instead, at δ = 0, where q is q ⊕ δ:
///
/// | type | tangent | q ⊕ δ | with `perturbation = left` |
/// |---|---|---|---|
/// | `Quat`, and `Mat3` as a rotation | `Vec3`: a rotation vector ω | q · exp(ω), in the rotation's own frame | exp(ω) · q, in the frame that it leads to |
/// | `Rigid`, `Affine3A` | `(Vec3, Vec3)`: ω and a shift ρ | R · exp(ω), t + R ρ | exp(ω) · R, exp(ω) t + ρ |
/// | arrays, tuples | of their elements' tangents | each by itself | |
/// | structs | a tuple of their fields' tangents | each by itself | |
///
/// ```ignore
/// #[differentiate(wrt(tangent(turn), shift), gauss_newton)]
/// fn off(turn: Quat, shift: Vec3, point: Vec3, normal: Vec3) -> f32 {
///     normal.dot(turn * point + shift)
/// }
///
/// let (value, (by_turn, by_shift)) = off_gradient(turn, shift, point, normal); // two `Vec3`
/// let turn = (turn * Quat::from_scaled_axis(-0.1 * by_turn)).normalize(); // a step downhill
/// ```
///
/// It is one rule, ∂(R v) = R (ω × v), not the algebra of four or nine numbers: three numbers cost less than four. All companions are by the
/// tangent, Hessians too: δ counts to the second order.
///
/// # Where a formula is 0 / 0
///
/// Where value and derivatives have a limit, they are the limit, first and second ones. `x.sin() / x` is 1 at 0 with slope 0,
/// `v.length() * v.normalize()` is v, and a turn by `Quat::from_axis_angle(v.normalize(), v.length())` has its derivative at
/// v = 0, as `q.to_scaled_axis()` has at the identity. No `if` is needed around them. What is multiplied and divided by the same
/// cancels; of sin, tan, asin, atan2, sinh, tanh, 1 − cos, x − sin and acos a power of their argument does, and a
/// series is left near the point, which counts apart from operations.
///
/// # Where there is no derivative
///
/// A length that is zero has direction 0 and derivative 0 (a cross product's length with such a direction is that of the
/// other vector); the derivative of a square root at 0 is 0; at a comparison's
/// edge the derivative is that of the branch taken (`max` and `min` of equals take the receiver, `abs` of 0 the positive
/// branch), and a sign has derivative 0. A power of 0 has derivative 0 by its base and by its exponent; a remainder is `x − y⌊x / y⌋` with
/// a whole number that is constant. Comparisons take NaN for a number that is not below another, so `max` and `min` hand it
/// on, which those of `f32` do not. So derivatives are NaN only where the
/// function itself is, or where a step on the way to it overflows: `1.0 / (1.0 + (-x).exp())` is 0 for x = −100 in `f32`,
/// but the exponential is infinite. Exponentials of what is at most 0 are safe.
#[proc_macro_attribute]
pub fn differentiate(attribute: TokenStream, item: TokenStream) -> TokenStream {
    aim_codegen::differentiate(attribute.into(), item.into(), "aim").into()
}

/// [`macro@differentiate`] for those who take it from the crate `derivand`.
#[doc(hidden)]
#[proc_macro_attribute]
pub fn differentiate_by_derivand(attribute: TokenStream, item: TokenStream) -> TokenStream {
    aim_codegen::differentiate(attribute.into(), item.into(), "derivand").into()
}

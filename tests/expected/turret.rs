// What the derive makes of a declaration in tests/src/declarations.rs; rewritten by
// AIM_BLESS=1 cargo test -p aim-tests --test golden
#[allow(
    clippy::approx_constant,
    clippy::manual_range_patterns,
    clippy::too_many_lines,
    clippy::unreadable_literal,
    reason = "derived code is for machines: its numbers and its length are those of the rig"
)]
const _: () = {
    impl Turret {
        /// The names that each joint's bone may have in a model, from the effector inward.
        #[allow(
            dead_code,
            unreachable_pub,
            reason = "a rig need not be looked up by its bones' names"
        )]
        pub const BONES: [&'static [&'static ::core::primitive::str]; 2] = [
            &["barrel"],
            &["base"],
        ];
    }
    #[automatically_derived]
    impl ::core::default::Default for Turret {
        /// At rest: every angle 0.
        fn default() -> Self {
            Self {
                barrel: ::core::default::Default::default(),
                base: ::core::default::Default::default(),
            }
        }
    }
    #[automatically_derived]
    impl ::core::fmt::Debug for Turret {
        fn fmt(
            &self,
            __formatter: &mut ::core::fmt::Formatter<'_>,
        ) -> ::core::fmt::Result {
            ::core::fmt::DebugStruct::finish(
                ::core::fmt::DebugStruct::field(
                    ::core::fmt::DebugStruct::field(
                        &mut ::core::fmt::Formatter::debug_struct(__formatter, "Turret"),
                        "barrel",
                        &self.barrel,
                    ),
                    "base",
                    &self.base,
                ),
            )
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for Turret {
        type Array<T: ::core::marker::Copy> = [T; 2];
        #[inline]
        fn array<T: ::core::marker::Copy>(&self, __value: T) -> [T; 2] {
            [__value; 2]
        }
        #[inline]
        fn joint_infos(&self) -> &[::aim::__private::JointInfo] {
            const INFOS: [::aim::__private::JointInfo; 2] = [
                ::aim::__private::JointInfo::new(
                        ::aim::__private::Axes {
                            up: [0.0, 1.0, 0.0],
                            forward: [0.0, 0.0, -1.0],
                            left: [-1.0, 0.0, 0.0],
                        },
                        1.5707964,
                    )
                    .with_pitch(-0.17453292, 1.3962634)
                    .with_comfort(1.0),
                ::aim::__private::JointInfo::new(
                        ::aim::__private::Axes {
                            up: [0.0, 1.0, 0.0],
                            forward: [0.0, 0.0, -1.0],
                            left: [-1.0, 0.0, 0.0],
                        },
                        2.0,
                    )
                    .with_heading(
                        <::core::primitive::f32>::NEG_INFINITY,
                        <::core::primitive::f32>::INFINITY,
                    )
                    .with_comfort(1.0),
            ];
            &INFOS
        }
        #[inline]
        fn effector(&self) -> ::aim::__private::Effector {
            ::aim::__private::Effector {
                forward: [0.0, 0.0, -1.0],
                origin: [0.0, 0.05, -0.8],
            }
        }
        #[inline]
        fn joints(&self) -> [::aim::__private::Joint; 2] {
            [self.barrel, self.base]
        }
        #[inline]
        fn joint(
            &self,
            __index: ::core::primitive::usize,
        ) -> ::core::option::Option<&::aim::__private::Joint> {
            match __index {
                0 => ::core::option::Option::Some(&self.barrel),
                1 => ::core::option::Option::Some(&self.base),
                _ => ::core::option::Option::None,
            }
        }
        #[inline]
        fn joint_mut(
            &mut self,
            __index: ::core::primitive::usize,
        ) -> ::core::option::Option<&mut ::aim::__private::Joint> {
            match __index {
                0 => ::core::option::Option::Some(&mut self.barrel),
                1 => ::core::option::Option::Some(&mut self.base),
                _ => ::core::option::Option::None,
            }
        }
        #[inline]
        fn set_joints(&mut self, __states: [::aim::__private::Joint; 2]) {
            [self.barrel, self.base] = __states;
        }
        #[inline]
        fn aim_gradient<S: ::aim::__private::Scalar>(
            &self,
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[S; 12],
            __target: &[S; 3],
            __sin_cos: &[S; 4],
        ) -> [S; 3] {
            match __joint {
                0 => aim_gradient_0(__effector_to_joint, __target, __sin_cos),
                1 => aim_gradient_1(__effector_to_joint, __target, __sin_cos),
                _ => [<S as ::aim::__private::Scalar>::ZERO; 3],
            }
        }
        #[inline]
        fn chain_value_gradient<S: ::aim::__private::Scalar>(
            &self,
            __links: &[[S; 12]],
            __target: &[S; 3],
            __sin_cos: &[[S; 4]],
            __out: &mut [S],
        ) {
            if let (
                ::core::result::Result::Ok(__links),
                ::core::result::Result::Ok(__sin_cos),
                ::core::result::Result::Ok(__out),
            ) = (
                <&[[S; 12]; 2] as ::core::convert::TryFrom<
                    &[[S; 12]],
                >>::try_from(__links),
                <&[[S; 4]; 2] as ::core::convert::TryFrom<
                    &[[S; 4]],
                >>::try_from(__sin_cos),
                <&mut [S; 3] as ::core::convert::TryFrom<
                    &mut [S],
                >>::try_from(&mut *__out),
            ) {
                *__out = value_gradient(__links, __target, __sin_cos);
            } else {
                <[S]>::fill(__out, <S as ::aim::__private::Scalar>::ZERO);
            }
        }
        #[inline]
        fn chain_residual_jacobian<S: ::aim::__private::Scalar>(
            &self,
            __links: &[[S; 12]],
            __target: &[S; 3],
            __sin_cos: &[[S; 4]],
            __out: &mut [S],
        ) {
            if let (
                ::core::result::Result::Ok(__links),
                ::core::result::Result::Ok(__sin_cos),
                ::core::result::Result::Ok(__out),
            ) = (
                <&[[S; 12]; 2] as ::core::convert::TryFrom<
                    &[[S; 12]],
                >>::try_from(__links),
                <&[[S; 4]; 2] as ::core::convert::TryFrom<
                    &[[S; 4]],
                >>::try_from(__sin_cos),
                <&mut [S; 6] as ::core::convert::TryFrom<
                    &mut [S],
                >>::try_from(&mut *__out),
            ) {
                *__out = residual_jacobian(__links, __target, __sin_cos);
            } else {
                <[S]>::fill(__out, <S as ::aim::__private::Scalar>::ZERO);
            }
        }
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `barrel`. 31 operations: 12 add, 17 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
    #[inline]
    fn aim_gradient_0<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __effector_to_joint[9] - __target[0];
        let __v1 = __target[2] * __sin_cos[0] + __target[1] * __sin_cos[1];
        let __v2 = __effector_to_joint[10] - __v1;
        let __v3 = __target[2] * __sin_cos[1] - __target[1] * __sin_cos[0];
        let __v4 = __effector_to_joint[11] - __v3;
        let __v5 = __v0 * __v0 + __v2 * __v2 + __v4 * __v4;
        let __v6 = <S as ::aim::__private::Scalar>::sqrt(__v5);
        let __v7 = <S as ::aim::__private::Scalar>::constant(1.0) / __v6;
        let __v8 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v6,
            __v7,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v9 = __v8
            * (__effector_to_joint[6] * __v0 + __effector_to_joint[7] * __v2
                + __effector_to_joint[8] * __v4);
        let __v10 = __v8 * __v9;
        let __v11 = __v3 * (__effector_to_joint[7] - __v2 * __v10);
        let __v12 = __v8 * (__v1 * (__effector_to_joint[8] - __v4 * __v10) - __v11);
        [__v9, __v12, <S as ::aim::__private::Scalar>::ZERO]
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `base`. 31 operations: 12 add, 17 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
    #[inline]
    fn aim_gradient_1<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __target[2] * __sin_cos[2] - __target[0] * __sin_cos[3];
        let __v1 = __v0 + __effector_to_joint[9];
        let __v2 = __effector_to_joint[10] - __target[1];
        let __v3 = __target[2] * __sin_cos[3] + __target[0] * __sin_cos[2];
        let __v4 = __effector_to_joint[11] - __v3;
        let __v5 = __v1 * __v1 + __v2 * __v2 + __v4 * __v4;
        let __v6 = <S as ::aim::__private::Scalar>::sqrt(__v5);
        let __v7 = <S as ::aim::__private::Scalar>::constant(1.0) / __v6;
        let __v8 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v6,
            __v7,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v9 = __v8
            * (__effector_to_joint[6] * __v1 + __effector_to_joint[7] * __v2
                + __effector_to_joint[8] * __v4);
        let __v10 = __v8 * __v9;
        let __v11 = __v3 * (__effector_to_joint[6] - __v1 * __v10);
        let __v12 = __v8 * (__v0 * (__effector_to_joint[8] - __v4 * __v10) + __v11);
        [__v9, <S as ::aim::__private::Scalar>::ZERO, __v12]
    }
    ///The chain's aim, then its derivatives. 77 operations: 31 add, 44 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 3] {
        let __v0 = __target[2] * __sin_cos[1][2] - __target[0] * __sin_cos[1][3];
        let __v1 = __v0 + __links[1][9];
        let __v2 = __links[1][10] - __target[1];
        let __v3 = __target[2] * __sin_cos[1][3] + __target[0] * __sin_cos[1][2];
        let __v4 = __links[1][11] - __v3;
        let __v5 = __links[1][0] * __v1 + __links[1][1] * __v2 + __links[1][2] * __v4
            + __links[0][9];
        let __v6 = __links[1][6] * __v1 + __links[1][7] * __v2 + __links[1][8] * __v4;
        let __v7 = __links[1][3] * __v1 + __links[1][4] * __v2 + __links[1][5] * __v4;
        let __v8 = __sin_cos[0][0] * __v6 + __sin_cos[0][1] * __v7;
        let __v9 = __v8 + __links[0][10];
        let __v10 = __sin_cos[0][1] * __v6 - __sin_cos[0][0] * __v7;
        let __v11 = __v10 + __links[0][11];
        let __v12 = __v5 * __v5 + __v9 * __v9 + __v11 * __v11;
        let __v13 = <S as ::aim::__private::Scalar>::sqrt(__v12);
        let __v14 = <S as ::aim::__private::Scalar>::constant(1.0) / __v13;
        let __v15 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v13,
            __v14,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v16 = __v15
            * (__links[0][6] * __v5 + __links[0][7] * __v9 + __links[0][8] * __v11);
        let __v17 = __v15 * __v16;
        let __v18 = __links[0][8] - __v11 * __v17;
        let __v19 = __links[0][7] - __v9 * __v17;
        let __v20 = __v15 * (__v10 * __v19 - __v8 * __v18);
        let __v21 = __links[0][6] - __v5 * __v17;
        let __v22 = __sin_cos[0][0] * __v18 - __sin_cos[0][1] * __v19;
        let __v23 = __sin_cos[0][1] * __v18 + __sin_cos[0][0] * __v19;
        let __v24 = __v0
            * (__links[1][2] * __v21 - __links[1][5] * __v22 + __links[1][8] * __v23);
        let __v25 = __v3
            * (__links[1][0] * __v21 - __links[1][3] * __v22 + __links[1][6] * __v23);
        let __v26 = __v15 * (__v24 + __v25);
        [__v16, __v20, __v26]
    }
    ///The chain's residual (left, up), then the derivatives of each. 126 operations: 48 add, 75 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Turret`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 6] {
        let __v0 = __target[2] * __sin_cos[1][2] - __target[0] * __sin_cos[1][3];
        let __v1 = __v0 + __links[1][9];
        let __v2 = __links[1][10] - __target[1];
        let __v3 = __target[2] * __sin_cos[1][3] + __target[0] * __sin_cos[1][2];
        let __v4 = __links[1][11] - __v3;
        let __v5 = __links[1][0] * __v1 + __links[1][1] * __v2 + __links[1][2] * __v4
            + __links[0][9];
        let __v6 = __links[1][6] * __v1 + __links[1][7] * __v2 + __links[1][8] * __v4;
        let __v7 = __links[1][3] * __v1 + __links[1][4] * __v2 + __links[1][5] * __v4;
        let __v8 = __sin_cos[0][0] * __v6 + __sin_cos[0][1] * __v7;
        let __v9 = __v8 + __links[0][10];
        let __v10 = __sin_cos[0][1] * __v6 - __sin_cos[0][0] * __v7;
        let __v11 = __v10 + __links[0][11];
        let __v12 = __v11 * __v11 + __v5 * __v5 + __v9 * __v9;
        let __v13 = <S as ::aim::__private::Scalar>::sqrt(__v12);
        let __v14 = __links[0][6] * __v5 + __links[0][7] * __v9 + __links[0][8] * __v11
            + __v13;
        let __v15 = <S as ::aim::__private::Scalar>::constant(1.0) / __v14;
        let __v16 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v14,
            __v15,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v17 = <S as ::aim::__private::Scalar>::constant(2.0) * __v16;
        let __v18 = __links[0][0] * __v5 + __links[0][1] * __v9 + __links[0][2] * __v11;
        let __v19 = __v17 * __v18;
        let __v20 = __links[0][3] * __v5 + __links[0][4] * __v9 + __links[0][5] * __v11;
        let __v21 = __v17 * __v20;
        let __v22 = <S as ::aim::__private::Scalar>::constant(1.0) / __v13;
        let __v23 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v13,
            __v22,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v24 = __v23 * (__v8 * __v11 - __v10 * __v9);
        let __v25 = __links[0][7] * __v10 - __links[0][8] * __v8 - __v24;
        let __v26 = __v16 * __v17;
        let __v27 = __v18 * __v26;
        let __v28 = __v17 * (__links[0][1] * __v10 - __links[0][2] * __v8)
            - __v25 * __v27;
        let __v29 = __links[1][0] * __v3 + __links[1][2] * __v0;
        let __v30 = __links[1][6] * __v3 + __links[1][8] * __v0;
        let __v31 = __links[1][3] * __v3 + __links[1][5] * __v0;
        let __v32 = __sin_cos[0][0] * __v30 + __sin_cos[0][1] * __v31;
        let __v33 = __sin_cos[0][1] * __v30 - __sin_cos[0][0] * __v31;
        let __v34 = __v17
            * (__links[0][0] * __v29 + __links[0][1] * __v32 + __links[0][2] * __v33);
        let __v35 = __v23 * (__v11 * __v33 + __v5 * __v29 + __v9 * __v32);
        let __v36 = __links[0][6] * __v29 + __links[0][7] * __v32 + __links[0][8] * __v33
            + __v35;
        let __v37 = __v34 - __v36 * __v27;
        let __v38 = __v20 * __v26;
        let __v39 = __v17 * (__links[0][5] * __v8 - __links[0][4] * __v10)
            + __v25 * __v38;
        let __v40 = __v17
            * (__links[0][3] * __v29 + __links[0][4] * __v32 + __links[0][5] * __v33);
        let __v41 = __v36 * __v38 - __v40;
        [__v19, -__v21, __v28, __v37, __v39, __v41]
    }
};

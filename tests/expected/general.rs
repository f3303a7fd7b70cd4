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
    impl General {
        /// The names that each joint's bone may have in a model, from the effector inward.
        #[allow(
            dead_code,
            unreachable_pub,
            reason = "a rig need not be looked up by its bones' names"
        )]
        pub const BONES: [&'static [&'static ::core::primitive::str]; 2] = [
            &["L_eye", "LeftEye"],
            &["neck"],
        ];
    }
    #[automatically_derived]
    impl ::core::default::Default for General {
        /// At rest: every angle 0.
        fn default() -> Self {
            Self {
                left_eye: ::core::default::Default::default(),
                r#neck: ::core::default::Default::default(),
            }
        }
    }
    #[automatically_derived]
    impl ::core::fmt::Debug for General {
        fn fmt(
            &self,
            __formatter: &mut ::core::fmt::Formatter<'_>,
        ) -> ::core::fmt::Result {
            ::core::fmt::DebugStruct::finish(
                ::core::fmt::DebugStruct::field(
                    ::core::fmt::DebugStruct::field(
                        &mut ::core::fmt::Formatter::debug_struct(
                            __formatter,
                            "General",
                        ),
                        "left_eye",
                        &self.left_eye,
                    ),
                    "neck",
                    &self.r#neck,
                ),
            )
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for General {
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
                            up: [-0.000000000000000016653346, 0.96, 0.28],
                            forward: [0.6, -0.224, 0.768],
                            left: [0.8, 0.168, -0.576],
                        },
                        7.5,
                    )
                    .with_heading(-0.6, 0.6)
                    .with_pitch(-0.4, 0.35)
                    .with_acceleration(200.0)
                    .with_comfort(0.5)
                    .with_role(::aim::__private::Role::Eye),
                ::aim::__private::JointInfo::new(
                        ::aim::__private::Axes {
                            up: [0.0, 0.0, -1.0],
                            forward: [1.0, 0.0, 0.0],
                            left: [0.0, 1.0, 0.0],
                        },
                        2.9670596,
                    )
                    .with_heading(-1.0471976, 1.0471976)
                    .with_pitch(-0.6981317, 0.61086524)
                    .with_comfort(1.0)
                    .with_level(0.5)
                    .with_narrowing(0.25)
                    .with_role(::aim::__private::Role::Neck)
                    .with_absolute_range(),
            ];
            &INFOS
        }
        #[inline]
        fn effector(&self) -> ::aim::__private::Effector {
            ::aim::__private::Effector {
                forward: [0.0, 0.0, 1.0],
                origin: [0.0, 0.0, 0.0],
            }
        }
        fn natural(&self) -> ::aim::__private::Natural {
            <::aim::__private::Natural as ::core::default::Default>::default()
                .with_eyes_only(0.17453292)
                .with_head_share(0.7)
                .with_engagement(0.25, 0.08726646)
                .with_delay(0.05)
        }
        #[inline]
        fn joints(&self) -> [::aim::__private::Joint; 2] {
            [self.left_eye, self.r#neck]
        }
        #[inline]
        fn joint(
            &self,
            __index: ::core::primitive::usize,
        ) -> ::core::option::Option<&::aim::__private::Joint> {
            match __index {
                0 => ::core::option::Option::Some(&self.left_eye),
                1 => ::core::option::Option::Some(&self.r#neck),
                _ => ::core::option::Option::None,
            }
        }
        #[inline]
        fn joint_mut(
            &mut self,
            __index: ::core::primitive::usize,
        ) -> ::core::option::Option<&mut ::aim::__private::Joint> {
            match __index {
                0 => ::core::option::Option::Some(&mut self.left_eye),
                1 => ::core::option::Option::Some(&mut self.r#neck),
                _ => ::core::option::Option::None,
            }
        }
        #[inline]
        fn set_joints(&mut self, __states: [::aim::__private::Joint; 2]) {
            [self.left_eye, self.r#neck] = __states;
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
                <&mut [S; 5] as ::core::convert::TryFrom<
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
                <&mut [S; 10] as ::core::convert::TryFrom<
                    &mut [S],
                >>::try_from(&mut *__out),
            ) {
                *__out = residual_jacobian(__links, __target, __sin_cos);
            } else {
                <[S]>::fill(__out, <S as ::aim::__private::Scalar>::ZERO);
            }
        }
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `left_eye`. 91 operations: 35 add, 54 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `General`.
    #[inline]
    fn aim_gradient_0<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __target[1] * <S as ::aim::__private::Scalar>::constant(0.224)
            - __target[0] * <S as ::aim::__private::Scalar>::constant(0.6)
            - __target[2] * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v1 = __target[0] * <S as ::aim::__private::Scalar>::constant(0.8)
            + __target[1]
                * <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
            - __target[2]
                * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v2 = __sin_cos[3] * __v0 - __sin_cos[2] * __v1;
        let __v3 = __target[0]
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            ) - __target[1] * <S as ::aim::__private::Scalar>::constant(0.96)
            - __target[2] * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v4 = __sin_cos[1] * __v2 + __sin_cos[0] * __v3;
        let __v5 = __sin_cos[2] * __v0 + __sin_cos[3] * __v1;
        let __v6 = __sin_cos[0] * __v2 - __sin_cos[1] * __v3;
        let __v7 = <S as ::aim::__private::Scalar>::constant(0.8) * __v5
            - <S as ::aim::__private::Scalar>::constant(0.6) * __v4
            - <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            ) * __v6 - __effector_to_joint[9];
        let __v8 = <S as ::aim::__private::Scalar>::constant(0.224) * __v4
            + <S as ::aim::__private::Scalar>::constant(0.16800000000000004) * __v5
            + <S as ::aim::__private::Scalar>::constant(0.96) * __v6
            - __effector_to_joint[10];
        let __v9 = <S as ::aim::__private::Scalar>::constant(0.28) * __v6
            - (<S as ::aim::__private::Scalar>::constant(0.768) * __v4
                + <S as ::aim::__private::Scalar>::constant(0.5760000000000001) * __v5)
            - __effector_to_joint[11];
        let __v10 = __v7 * __v7 + __v8 * __v8 + __v9 * __v9;
        let __v11 = <S as ::aim::__private::Scalar>::sqrt(__v10);
        let __v12 = <S as ::aim::__private::Scalar>::constant(1.0) / __v11;
        let __v13 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v11,
            __v12,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v14 = __v13
            * (__effector_to_joint[6] * __v7 + __effector_to_joint[7] * __v8
                + __effector_to_joint[8] * __v9);
        let __v15 = __v13 * __v14;
        let __v16 = __effector_to_joint[6] - __v7 * __v15;
        let __v17 = __effector_to_joint[7] - __v8 * __v15;
        let __v18 = __effector_to_joint[8] - __v9 * __v15;
        let __v19 = <S as ::aim::__private::Scalar>::constant(0.6) * __v16
            - <S as ::aim::__private::Scalar>::constant(0.224) * __v17
            + <S as ::aim::__private::Scalar>::constant(0.768) * __v18;
        let __v20 = <S as ::aim::__private::Scalar>::constant(0.28) * __v18
            - (<S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            ) * __v16 - <S as ::aim::__private::Scalar>::constant(0.96) * __v17);
        let __v21 = __v13 * (__v6 * __v19 + __v4 * __v20);
        let __v22 = __v2
            * (<S as ::aim::__private::Scalar>::constant(0.5760000000000001) * __v18
                - (<S as ::aim::__private::Scalar>::constant(0.8) * __v16
                    + <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
                        * __v17));
        let __v23 = __v13
            * (__v5 * (__sin_cos[1] * __v19 - __sin_cos[0] * __v20) - __v22);
        [__v14, __v21, __v23]
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `neck`. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `General`.
    #[inline]
    fn aim_gradient_1<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __target[0] * __sin_cos[3] + __target[1] * __sin_cos[2];
        let __v1 = __sin_cos[1] * __v0 - __target[2] * __sin_cos[0];
        let __v2 = __v1 - __effector_to_joint[9];
        let __v3 = __target[1] * __sin_cos[3] - __target[0] * __sin_cos[2];
        let __v4 = __v3 - __effector_to_joint[10];
        let __v5 = __sin_cos[0] * __v0 + __target[2] * __sin_cos[1];
        let __v6 = __v5 - __effector_to_joint[11];
        let __v7 = __v2 * __v2 + __v4 * __v4 + __v6 * __v6;
        let __v8 = <S as ::aim::__private::Scalar>::sqrt(__v7);
        let __v9 = <S as ::aim::__private::Scalar>::constant(1.0) / __v8;
        let __v10 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v8,
            __v9,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v11 = __v10
            * (__effector_to_joint[6] * __v2 + __effector_to_joint[7] * __v4
                + __effector_to_joint[8] * __v6);
        let __v12 = __v10 * __v11;
        let __v13 = __effector_to_joint[6] - __v2 * __v12;
        let __v14 = __effector_to_joint[8] - __v6 * __v12;
        let __v15 = __v10 * (__v1 * __v14 - __v5 * __v13);
        let __v16 = __v0 * (__effector_to_joint[7] - __v4 * __v12);
        let __v17 = __v10
            * (__v3 * (__sin_cos[1] * __v13 + __sin_cos[0] * __v14) - __v16);
        [__v11, __v15, __v17]
    }
    ///The chain's aim, then its derivatives. 170 operations: 66 add, 102 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `General`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 5] {
        let __v0 = __target[0] * __sin_cos[1][3] + __target[1] * __sin_cos[1][2];
        let __v1 = __sin_cos[1][1] * __v0 - __target[2] * __sin_cos[1][0];
        let __v2 = __links[1][9] - __v1;
        let __v3 = __target[1] * __sin_cos[1][3] - __target[0] * __sin_cos[1][2];
        let __v4 = __links[1][10] - __v3;
        let __v5 = __sin_cos[1][0] * __v0 + __target[2] * __sin_cos[1][1];
        let __v6 = __links[1][11] - __v5;
        let __v7 = __links[1][0] * __v2 + __links[1][1] * __v4 + __links[1][2] * __v6;
        let __v8 = __links[1][3] * __v2 + __links[1][4] * __v4 + __links[1][5] * __v6;
        let __v9 = __links[1][6] * __v2 + __links[1][7] * __v4 + __links[1][8] * __v6;
        let __v10 = __v7 * <S as ::aim::__private::Scalar>::constant(0.6)
            - __v8 * <S as ::aim::__private::Scalar>::constant(0.224)
            + __v9 * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v11 = __v9 * <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
            - (__v7 * <S as ::aim::__private::Scalar>::constant(0.8)
                + __v8 * <S as ::aim::__private::Scalar>::constant(0.16800000000000004));
        let __v12 = __sin_cos[0][3] * __v10 - __sin_cos[0][2] * __v11;
        let __v13 = __v9 * <S as ::aim::__private::Scalar>::constant(0.28)
            - (__v7
                * <S as ::aim::__private::Scalar>::constant(
                    0.000000000000000016653345369377347,
                ) - __v8 * <S as ::aim::__private::Scalar>::constant(0.96));
        let __v14 = __sin_cos[0][1] * __v12 + __sin_cos[0][0] * __v13;
        let __v15 = __sin_cos[0][2] * __v10 + __sin_cos[0][3] * __v11;
        let __v16 = __sin_cos[0][0] * __v12 - __sin_cos[0][1] * __v13;
        let __v17 = <S as ::aim::__private::Scalar>::constant(0.6) * __v14
            - <S as ::aim::__private::Scalar>::constant(0.8) * __v15
            + <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            ) * __v16 + __links[0][9];
        let __v18 = __links[0][10]
            - (<S as ::aim::__private::Scalar>::constant(0.224) * __v14
                + <S as ::aim::__private::Scalar>::constant(0.16800000000000004) * __v15
                + <S as ::aim::__private::Scalar>::constant(0.96) * __v16);
        let __v19 = __links[0][11]
            - (<S as ::aim::__private::Scalar>::constant(0.28) * __v16
                - (<S as ::aim::__private::Scalar>::constant(0.768) * __v14
                    + <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
                        * __v15));
        let __v20 = __v17 * __v17 + __v18 * __v18 + __v19 * __v19;
        let __v21 = <S as ::aim::__private::Scalar>::sqrt(__v20);
        let __v22 = <S as ::aim::__private::Scalar>::constant(1.0) / __v21;
        let __v23 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v21,
            __v22,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v24 = __v23
            * (__links[0][6] * __v17 + __links[0][7] * __v18 + __links[0][8] * __v19);
        let __v25 = __v23 * __v24;
        let __v26 = __v23 * (__links[0][6] - __v17 * __v25);
        let __v27 = __v23 * (__links[0][7] - __v18 * __v25);
        let __v28 = __v23 * (__links[0][8] - __v19 * __v25);
        let __v29 = <S as ::aim::__private::Scalar>::constant(0.6) * __v26
            - <S as ::aim::__private::Scalar>::constant(0.224) * __v27
            + <S as ::aim::__private::Scalar>::constant(0.768) * __v28;
        let __v30 = <S as ::aim::__private::Scalar>::constant(0.28) * __v28
            - (<S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            ) * __v26 - <S as ::aim::__private::Scalar>::constant(0.96) * __v27);
        let __v31 = __v16 * __v29 + __v14 * __v30;
        let __v32 = __sin_cos[0][1] * __v29 - __sin_cos[0][0] * __v30;
        let __v33 = <S as ::aim::__private::Scalar>::constant(0.5760000000000001) * __v28
            - (<S as ::aim::__private::Scalar>::constant(0.8) * __v26
                + <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
                    * __v27);
        let __v34 = __v15 * __v32 - __v12 * __v33;
        let __v35 = __sin_cos[0][3] * __v32 + __sin_cos[0][2] * __v33;
        let __v36 = __sin_cos[0][2] * __v32 - __sin_cos[0][3] * __v33;
        let __v37 = __sin_cos[0][0] * __v29 + __sin_cos[0][1] * __v30;
        let __v38 = <S as ::aim::__private::Scalar>::constant(0.768) * __v35
            - <S as ::aim::__private::Scalar>::constant(0.5760000000000001) * __v36
            + <S as ::aim::__private::Scalar>::constant(0.28) * __v37;
        let __v39 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v37
            - (<S as ::aim::__private::Scalar>::constant(0.6) * __v35
                + <S as ::aim::__private::Scalar>::constant(0.8) * __v36);
        let __v40 = <S as ::aim::__private::Scalar>::constant(0.96) * __v37
            - (<S as ::aim::__private::Scalar>::constant(0.224) * __v35
                - <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
                    * __v36);
        let __v41 = __links[1][6] * __v38
            - (__links[1][0] * __v39 - __links[1][3] * __v40);
        let __v42 = __links[1][8] * __v38
            - (__links[1][2] * __v39 - __links[1][5] * __v40);
        let __v43 = __v1 * __v42 - __v5 * __v41;
        let __v44 = __v0
            * (__links[1][1] * __v39 - __links[1][4] * __v40 - __links[1][7] * __v38);
        let __v45 = __v3 * (__sin_cos[1][1] * __v41 + __sin_cos[1][0] * __v42) + __v44;
        [-__v24, __v31, __v34, __v43, __v45]
    }
    ///The chain's residual (left, up), then the derivatives of each. 311 operations: 122 add, 186 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `General`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 10] {
        let __v0 = __target[0] * __sin_cos[1][3] + __target[1] * __sin_cos[1][2];
        let __v1 = __sin_cos[1][1] * __v0 - __target[2] * __sin_cos[1][0];
        let __v2 = __links[1][9] - __v1;
        let __v3 = __target[1] * __sin_cos[1][3] - __target[0] * __sin_cos[1][2];
        let __v4 = __links[1][10] - __v3;
        let __v5 = __sin_cos[1][0] * __v0 + __target[2] * __sin_cos[1][1];
        let __v6 = __links[1][11] - __v5;
        let __v7 = __links[1][0] * __v2 + __links[1][1] * __v4 + __links[1][2] * __v6;
        let __v8 = __links[1][3] * __v2 + __links[1][4] * __v4 + __links[1][5] * __v6;
        let __v9 = __links[1][6] * __v2 + __links[1][7] * __v4 + __links[1][8] * __v6;
        let __v10 = __v7 * <S as ::aim::__private::Scalar>::constant(0.6)
            - __v8 * <S as ::aim::__private::Scalar>::constant(0.224)
            + __v9 * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v11 = __v9 * <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
            - (__v7 * <S as ::aim::__private::Scalar>::constant(0.8)
                + __v8 * <S as ::aim::__private::Scalar>::constant(0.16800000000000004));
        let __v12 = __sin_cos[0][3] * __v10 - __sin_cos[0][2] * __v11;
        let __v13 = __v9 * <S as ::aim::__private::Scalar>::constant(0.28)
            - (__v7
                * <S as ::aim::__private::Scalar>::constant(
                    0.000000000000000016653345369377347,
                ) - __v8 * <S as ::aim::__private::Scalar>::constant(0.96));
        let __v14 = __sin_cos[0][1] * __v12 + __sin_cos[0][0] * __v13;
        let __v15 = __v14
            + (__links[0][9] * <S as ::aim::__private::Scalar>::constant(0.6)
                - __links[0][10] * <S as ::aim::__private::Scalar>::constant(0.224)
                + __links[0][11] * <S as ::aim::__private::Scalar>::constant(0.768));
        let __v16 = __sin_cos[0][2] * __v10 + __sin_cos[0][3] * __v11;
        let __v17 = __v16
            + (__links[0][11]
                * <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
                - (__links[0][9] * <S as ::aim::__private::Scalar>::constant(0.8)
                    + __links[0][10]
                        * <S as ::aim::__private::Scalar>::constant(
                            0.16800000000000004,
                        )));
        let __v18 = __sin_cos[0][0] * __v12 - __sin_cos[0][1] * __v13;
        let __v19 = __v18
            - (__links[0][11] * <S as ::aim::__private::Scalar>::constant(0.28)
                - (__links[0][9]
                    * <S as ::aim::__private::Scalar>::constant(
                        0.000000000000000016653345369377347,
                    )
                    - __links[0][10] * <S as ::aim::__private::Scalar>::constant(0.96)));
        let __v20 = __v15 * __v15 + __v17 * __v17 + __v19 * __v19;
        let __v21 = <S as ::aim::__private::Scalar>::sqrt(__v20);
        let __v22 = <S as ::aim::__private::Scalar>::constant(0.6) * __v14
            - <S as ::aim::__private::Scalar>::constant(0.8) * __v16
            + <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            ) * __v18 + __links[0][9];
        let __v23 = __links[0][10]
            - (<S as ::aim::__private::Scalar>::constant(0.224) * __v14
                + <S as ::aim::__private::Scalar>::constant(0.16800000000000004) * __v16
                + <S as ::aim::__private::Scalar>::constant(0.96) * __v18);
        let __v24 = __links[0][11]
            - (<S as ::aim::__private::Scalar>::constant(0.28) * __v18
                - (<S as ::aim::__private::Scalar>::constant(0.768) * __v14
                    + <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
                        * __v16));
        let __v25 = __v21
            - (__links[0][6] * __v22 + __links[0][7] * __v23 + __links[0][8] * __v24);
        let __v26 = <S as ::aim::__private::Scalar>::constant(1.0) / __v25;
        let __v27 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v25,
            __v26,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v28 = <S as ::aim::__private::Scalar>::constant(2.0) * __v27;
        let __v29 = __links[0][0]
            + __links[0][3]
                * <S as ::aim::__private::Scalar>::constant(
                    0.00000000000000001734723475976807,
                );
        let __v30 = __links[0][1]
            + __links[0][4]
                * <S as ::aim::__private::Scalar>::constant(
                    0.00000000000000001734723475976807,
                );
        let __v31 = __links[0][2]
            + __links[0][5]
                * <S as ::aim::__private::Scalar>::constant(
                    0.00000000000000001734723475976807,
                );
        let __v32 = __v22 * __v29 + __v23 * __v30 + __v24 * __v31;
        let __v33 = __v28 * __v32;
        let __v34 = __links[0][0]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            ) - __links[0][3];
        let __v35 = __links[0][1]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            ) - __links[0][4];
        let __v36 = __links[0][2]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            ) - __links[0][5];
        let __v37 = __v22 * __v34 + __v23 * __v35 + __v24 * __v36;
        let __v38 = __v28 * __v37;
        let __v39 = __v27 * __v28;
        let __v40 = __v32 * __v39;
        let __v41 = __v28 * __v29 + __links[0][6] * __v40;
        let __v42 = __v28 * __v30 + __links[0][7] * __v40;
        let __v43 = __v28 * __v31 + __links[0][8] * __v40;
        let __v44 = <S as ::aim::__private::Scalar>::constant(1.0) / __v21;
        let __v45 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v21,
            __v44,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v46 = __v45 * __v40;
        let __v47 = __v15 * __v46;
        let __v48 = <S as ::aim::__private::Scalar>::constant(0.6) * __v41
            - <S as ::aim::__private::Scalar>::constant(0.224) * __v42
            + <S as ::aim::__private::Scalar>::constant(0.768) * __v43 - __v47;
        let __v49 = __v19 * __v46;
        let __v50 = <S as ::aim::__private::Scalar>::constant(0.28) * __v43
            - (<S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            ) * __v41 - <S as ::aim::__private::Scalar>::constant(0.96) * __v42) + __v49;
        let __v51 = __v18 * __v48 + __v14 * __v50;
        let __v52 = __sin_cos[0][1] * __v48 - __sin_cos[0][0] * __v50;
        let __v53 = __v17 * __v46;
        let __v54 = <S as ::aim::__private::Scalar>::constant(0.5760000000000001) * __v43
            - (<S as ::aim::__private::Scalar>::constant(0.8) * __v41
                + <S as ::aim::__private::Scalar>::constant(0.16800000000000004) * __v42)
            - __v53;
        let __v55 = __v16 * __v52 - __v12 * __v54;
        let __v56 = __sin_cos[0][3] * __v52 + __sin_cos[0][2] * __v54;
        let __v57 = __sin_cos[0][2] * __v52 - __sin_cos[0][3] * __v54;
        let __v58 = __sin_cos[0][0] * __v48 + __sin_cos[0][1] * __v50;
        let __v59 = <S as ::aim::__private::Scalar>::constant(0.768) * __v56
            - <S as ::aim::__private::Scalar>::constant(0.5760000000000001) * __v57
            + <S as ::aim::__private::Scalar>::constant(0.28) * __v58;
        let __v60 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v58
            - (<S as ::aim::__private::Scalar>::constant(0.6) * __v56
                + <S as ::aim::__private::Scalar>::constant(0.8) * __v57);
        let __v61 = <S as ::aim::__private::Scalar>::constant(0.96) * __v58
            - (<S as ::aim::__private::Scalar>::constant(0.224) * __v56
                - <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
                    * __v57);
        let __v62 = __links[1][6] * __v59
            - (__links[1][0] * __v60 - __links[1][3] * __v61);
        let __v63 = __links[1][8] * __v59
            - (__links[1][2] * __v60 - __links[1][5] * __v61);
        let __v64 = __v1 * __v63 - __v5 * __v62;
        let __v65 = __v0
            * (__links[1][1] * __v60 - __links[1][4] * __v61 - __links[1][7] * __v59);
        let __v66 = __v3 * (__sin_cos[1][1] * __v62 + __sin_cos[1][0] * __v63) + __v65;
        let __v67 = __v37 * __v39;
        let __v68 = __v28 * __v34 + __links[0][6] * __v67;
        let __v69 = __v28 * __v35 + __links[0][7] * __v67;
        let __v70 = __v28 * __v36 + __links[0][8] * __v67;
        let __v71 = __v45 * __v67;
        let __v72 = __v15 * __v71;
        let __v73 = <S as ::aim::__private::Scalar>::constant(0.224) * __v69
            - <S as ::aim::__private::Scalar>::constant(0.6) * __v68
            - <S as ::aim::__private::Scalar>::constant(0.768) * __v70 + __v72;
        let __v74 = __v19 * __v71;
        let __v75 = <S as ::aim::__private::Scalar>::constant(0.28) * __v70
            + (<S as ::aim::__private::Scalar>::constant(0.96) * __v69
                - <S as ::aim::__private::Scalar>::constant(
                    0.000000000000000016653345369377347,
                ) * __v68) + __v74;
        let __v76 = __v18 * __v73 - __v14 * __v75;
        let __v77 = __sin_cos[0][1] * __v73 + __sin_cos[0][0] * __v75;
        let __v78 = __v17 * __v71;
        let __v79 = <S as ::aim::__private::Scalar>::constant(0.8) * __v68
            + <S as ::aim::__private::Scalar>::constant(0.16800000000000004) * __v69
            - <S as ::aim::__private::Scalar>::constant(0.5760000000000001) * __v70
            + __v78;
        let __v80 = __v16 * __v77 - __v12 * __v79;
        let __v81 = __sin_cos[0][3] * __v77 + __sin_cos[0][2] * __v79;
        let __v82 = __sin_cos[0][2] * __v77 - __sin_cos[0][3] * __v79;
        let __v83 = __sin_cos[0][0] * __v73 - __sin_cos[0][1] * __v75;
        let __v84 = <S as ::aim::__private::Scalar>::constant(0.768) * __v81
            - <S as ::aim::__private::Scalar>::constant(0.5760000000000001) * __v82
            + <S as ::aim::__private::Scalar>::constant(0.28) * __v83;
        let __v85 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v83
            - (<S as ::aim::__private::Scalar>::constant(0.6) * __v81
                + <S as ::aim::__private::Scalar>::constant(0.8) * __v82);
        let __v86 = <S as ::aim::__private::Scalar>::constant(0.96) * __v83
            - (<S as ::aim::__private::Scalar>::constant(0.224) * __v81
                - <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
                    * __v82);
        let __v87 = __links[1][6] * __v84
            - (__links[1][0] * __v85 - __links[1][3] * __v86);
        let __v88 = __links[1][8] * __v84
            - (__links[1][2] * __v85 - __links[1][5] * __v86);
        let __v89 = __v1 * __v88 - __v5 * __v87;
        let __v90 = __v0
            * (__links[1][7] * __v84 - (__links[1][1] * __v85 - __links[1][4] * __v86));
        let __v91 = __v3 * (__sin_cos[1][1] * __v87 + __sin_cos[1][0] * __v88) - __v90;
        [-__v33, __v38, __v51, __v55, __v64, __v66, __v76, __v80, __v89, __v91]
    }
};

// The rig Extra, derived and written by aim 0.1.0. Do not edit: generate again.
///The rig `Extra`: its joints, from the effector inward.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::default::Default
)]
pub struct Extra {
    ///Moves the bone `head`.
    pub head: ::aim::Joint,
}
///A value for each joint of [`Extra`]: its pose, corrections, or anything else that is wanted by name.
#[allow(dead_code, reason = "a rig may be used without it")]
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub struct ExtraPose<T = ::aim::__private::Affine3A> {
    ///Of the joint `head`.
    pub head: T,
}
#[allow(
    clippy::approx_constant,
    clippy::inline_always,
    clippy::manual_range_patterns,
    clippy::too_many_lines,
    clippy::unreadable_literal,
    reason = "derived code is for machines: its numbers and its length are those of the rig"
)]
const _: () = {
    #[automatically_derived]
    impl ::aim::__private::Rig for Extra {
        #[inline]
        fn description(&self) -> ::aim::__private::Description<'_> {
            *<Self as ::aim::__private::AimRig>::DESCRIPTION
        }
        fn joint_name(
            &self,
            __joint: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match __joint {
                0 => ::core::option::Option::Some("head"),
                _ => ::core::option::Option::None,
            }
        }
        fn bone_name(
            &self,
            __joint: ::core::primitive::usize,
            __candidate: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match (__joint, __candidate) {
                (0, 0) => ::core::option::Option::Some("head"),
                _ => ::core::option::Option::None,
            }
        }
        ///The chain's stereographic residual (left, up), then the 2 derivatives of the first and of the second. 87 operations: 31 add, 53 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Extra`.
        #[inline(always)]
        fn residual_jacobian(
            &self,
            __links: &[[::core::primitive::f32; 12]],
            __target: &[::core::primitive::f32; 3],
            __sin_cos: &[[::core::primitive::f32; 4]],
            __out: &mut [::core::primitive::f32],
        ) {
            let (
                [__link_0,
                ],
                [__sin_cos_0,
                ],
                [__out_0,
                __out_1,
                __out_2,
                __out_3,
                __out_4,
                __out_5,
                ],
            ) = (__links, __sin_cos, &mut *__out) else {
                return <[::core::primitive::f32]>::fill(__out, 0.0);
            };
            let __v0 = __target[1] * __sin_cos_0[3] + __target[2] * __sin_cos_0[2];
            let __v1 = __sin_cos_0[1] * __v0 + __target[0] * __sin_cos_0[0];
            let __v2 = __v1 - __link_0[10];
            let __v3 = __target[2] * __sin_cos_0[3] - __target[1] * __sin_cos_0[2];
            let __v4 = __v3 - __link_0[11];
            let __v5 = __target[0] * __sin_cos_0[1] - __sin_cos_0[0] * __v0;
            let __v6 = __v5 - __link_0[9];
            let __v7 = __v2 * __v2 + __v4 * __v4 + __v6 * __v6;
            let __v8 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(__v7);
            let __v9 = __v8
                + (__link_0[3] * __v6 + __link_0[4] * __v2 + __link_0[5] * __v4);
            let __v10 = 1.0 / __v9;
            let __v11 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v9
            {
                __v10
            } else {
                0.0
            };
            let __v12 = 2.0 * __v11;
            let __v13 = __link_0[6] * __v6 + __link_0[7] * __v2 + __link_0[8] * __v4;
            let __v14 = __v12 * __v13;
            *__out_0 = __v14;
            let __v15 = __link_0[0] * __v6 + __link_0[1] * __v2 + __link_0[2] * __v4;
            let __v16 = __v12 * __v15;
            *__out_1 = __v16;
            let __v17 = 1.0 / __v8;
            let __v18 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v8
            {
                __v17
            } else {
                0.0
            };
            let __v19 = __link_0[4] + __v2 * __v18;
            let __v20 = __v11 * __v12;
            let __v21 = __v13 * __v20;
            let __v22 = __link_0[7] * __v12 - __v19 * __v21;
            let __v23 = __link_0[3] + __v6 * __v18;
            let __v24 = __link_0[6] * __v12 - __v23 * __v21;
            let __v25 = __v5 * __v22 - __v1 * __v24;
            *__out_2 = __v25;
            let __v26 = __link_0[5] + __v4 * __v18;
            let __v27 = __v0 * (__link_0[8] * __v12 - __v26 * __v21);
            let __v28 = __v3 * (__sin_cos_0[1] * __v22 - __sin_cos_0[0] * __v24) - __v27;
            *__out_3 = __v28;
            let __v29 = __v15 * __v20;
            let __v30 = __link_0[1] * __v12 - __v19 * __v29;
            let __v31 = __link_0[0] * __v12 - __v23 * __v29;
            let __v32 = __v5 * __v30 - __v1 * __v31;
            *__out_4 = __v32;
            let __v33 = __v0 * (__link_0[2] * __v12 - __v26 * __v29);
            let __v34 = __v3 * (__sin_cos_0[1] * __v30 - __sin_cos_0[0] * __v31) - __v33;
            *__out_5 = __v34;
        }
        ///Aim of joint `head`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
        fn aim_gradient(
            &self,
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[::core::primitive::f32; 12],
            __target: &[::core::primitive::f32; 3],
            __sin_cos: &[::core::primitive::f32; 4],
        ) -> [::core::primitive::f32; 3] {
            match __joint {
                0 => {
                    let __v0 = __target[1] * __sin_cos[3] + __target[2] * __sin_cos[2];
                    let __v1 = __target[0] * __sin_cos[1] - __sin_cos[0] * __v0;
                    let __v2 = __v1 - __effector_to_joint[9];
                    let __v3 = __sin_cos[1] * __v0 + __target[0] * __sin_cos[0];
                    let __v4 = __v3 - __effector_to_joint[10];
                    let __v5 = __target[2] * __sin_cos[3] - __target[1] * __sin_cos[2];
                    let __v6 = __v5 - __effector_to_joint[11];
                    let __v7 = __v2 * __v2 + __v4 * __v4 + __v6 * __v6;
                    let __v8 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                        __v7,
                    );
                    let __v9 = 1.0 / __v8;
                    let __v10 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                        < __v8
                    {
                        __v9
                    } else {
                        0.0
                    };
                    let __v11 = __v10
                        * (__effector_to_joint[3] * __v2 + __effector_to_joint[4] * __v4
                            + __effector_to_joint[5] * __v6);
                    let __v12 = __v10 * __v11;
                    let __v13 = __effector_to_joint[4] - __v4 * __v12;
                    let __v14 = __effector_to_joint[3] - __v2 * __v12;
                    let __v15 = __v10 * (__v1 * __v13 - __v3 * __v14);
                    let __v16 = __v0 * (__effector_to_joint[5] - __v6 * __v12);
                    let __v17 = __v10
                        * (__v5 * (__sin_cos[1] * __v13 - __sin_cos[0] * __v14) - __v16);
                    [__v11, __v15, __v17]
                }
                _ => [0.0, 0.0, 0.0],
            }
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for Extra {
        type Array<T: ::core::marker::Copy> = [T; 1];
        const RIG: &'static Self = &Self {
            head: ::aim::__private::Joint::REST,
        };
        const DESCRIPTION: &'static ::aim::__private::Description<'static> = &::aim::__private::Description::new(
                &[
                    ::aim::__private::JointInfo::new(
                            ::aim::__private::Axes {
                                up: [1.0, 0.0, 0.0],
                                forward: [0.0, 1.0, 0.0],
                                left: [0.0, 0.0, 1.0],
                            },
                            3.4906585,
                        )
                        .with_heading(-1.0471976, 1.0471976)
                        .with_pitch(-0.6981317, 0.61086524)
                        .with_stiffness(1.0)
                        .with_role(::aim::__private::Role::Head),
                ],
            )
            .with_effector(::aim::__private::Effector {
                forward: [0.0, 1.0, 0.0],
                origin: [0.09, 0.09, 0.0],
            });
        #[inline]
        fn array<T: ::core::marker::Copy>(__value: T) -> [T; 1] {
            [__value; 1]
        }
        #[inline]
        fn from_joints([__joint_0]: [::aim::__private::Joint; 1]) -> Self {
            Self { head: __joint_0 }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<Extra> for [::aim::__private::Joint; 1] {
        #[inline]
        fn from(__value: Extra) -> Self {
            [__value.head]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<ExtraPose<T>> for [T; 1] {
        #[inline]
        fn from(__pose: ExtraPose<T>) -> Self {
            [__pose.head]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<[T; 1]> for ExtraPose<T> {
        #[inline]
        fn from([__joint_0]: [T; 1]) -> Self {
            Self { head: __joint_0 }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<ExtraPose>
    for ::aim::__private::Pose<[::aim::__private::Affine3A; 1]> {
        #[inline]
        fn from(__pose: ExtraPose) -> Self {
            <Self>::new(::core::convert::Into::into(__pose))
        }
    }
    ///Aim of joint `head`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
    #[inline]
    fn aim_gradient_0<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __target[1] * __sin_cos[3] + __target[2] * __sin_cos[2];
        let __v1 = __target[0] * __sin_cos[1] - __sin_cos[0] * __v0;
        let __v2 = __v1 - __effector_to_joint[9];
        let __v3 = __sin_cos[1] * __v0 + __target[0] * __sin_cos[0];
        let __v4 = __v3 - __effector_to_joint[10];
        let __v5 = __target[2] * __sin_cos[3] - __target[1] * __sin_cos[2];
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
            * (__effector_to_joint[3] * __v2 + __effector_to_joint[4] * __v4
                + __effector_to_joint[5] * __v6);
        let __v12 = __v10 * __v11;
        let __v13 = __effector_to_joint[4] - __v4 * __v12;
        let __v14 = __effector_to_joint[3] - __v2 * __v12;
        let __v15 = __v10 * (__v1 * __v13 - __v3 * __v14);
        let __v16 = __v0 * (__effector_to_joint[5] - __v6 * __v12);
        let __v17 = __v10
            * (__v5 * (__sin_cos[1] * __v13 - __sin_cos[0] * __v14) - __v16);
        [__v11, __v15, __v17]
    }
    ///The chain's aim, then its 2 derivatives, pitch before heading, joint by joint. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
    #[inline]
    fn chain_value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 1],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 1],
    ) -> [S; 3] {
        let __v0 = __target[1] * __sin_cos[0][3] + __target[2] * __sin_cos[0][2];
        let __v1 = __target[0] * __sin_cos[0][1] - __sin_cos[0][0] * __v0;
        let __v2 = __v1 - __links[0][9];
        let __v3 = __sin_cos[0][1] * __v0 + __target[0] * __sin_cos[0][0];
        let __v4 = __v3 - __links[0][10];
        let __v5 = __target[2] * __sin_cos[0][3] - __target[1] * __sin_cos[0][2];
        let __v6 = __v5 - __links[0][11];
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
            * (__links[0][3] * __v2 + __links[0][4] * __v4 + __links[0][5] * __v6);
        let __v12 = __v10 * __v11;
        let __v13 = __links[0][4] - __v4 * __v12;
        let __v14 = __links[0][3] - __v2 * __v12;
        let __v15 = __v10 * (__v1 * __v13 - __v3 * __v14);
        let __v16 = __v0 * (__links[0][5] - __v6 * __v12);
        let __v17 = __v10
            * (__v5 * (__sin_cos[0][1] * __v13 - __sin_cos[0][0] * __v14) - __v16);
        [__v11, __v15, __v17]
    }
    ///The chain's stereographic residual (left, up), then the 2 derivatives of the first and of the second. 87 operations: 31 add, 53 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Extra`.
    #[inline]
    fn chain_residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 1],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 1],
    ) -> [S; 6] {
        let __v0 = __target[1] * __sin_cos[0][3] + __target[2] * __sin_cos[0][2];
        let __v1 = __sin_cos[0][1] * __v0 + __target[0] * __sin_cos[0][0];
        let __v2 = __v1 - __links[0][10];
        let __v3 = __target[2] * __sin_cos[0][3] - __target[1] * __sin_cos[0][2];
        let __v4 = __v3 - __links[0][11];
        let __v5 = __target[0] * __sin_cos[0][1] - __sin_cos[0][0] * __v0;
        let __v6 = __v5 - __links[0][9];
        let __v7 = __v2 * __v2 + __v4 * __v4 + __v6 * __v6;
        let __v8 = <S as ::aim::__private::Scalar>::sqrt(__v7);
        let __v9 = __v8
            + (__links[0][3] * __v6 + __links[0][4] * __v2 + __links[0][5] * __v4);
        let __v10 = <S as ::aim::__private::Scalar>::constant(1.0) / __v9;
        let __v11 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v9,
            __v10,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v12 = <S as ::aim::__private::Scalar>::constant(2.0) * __v11;
        let __v13 = __links[0][6] * __v6 + __links[0][7] * __v2 + __links[0][8] * __v4;
        let __v14 = __v12 * __v13;
        let __v15 = __links[0][0] * __v6 + __links[0][1] * __v2 + __links[0][2] * __v4;
        let __v16 = __v12 * __v15;
        let __v17 = <S as ::aim::__private::Scalar>::constant(1.0) / __v8;
        let __v18 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v8,
            __v17,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v19 = __links[0][4] + __v2 * __v18;
        let __v20 = __v11 * __v12;
        let __v21 = __v13 * __v20;
        let __v22 = __links[0][7] * __v12 - __v19 * __v21;
        let __v23 = __links[0][3] + __v6 * __v18;
        let __v24 = __links[0][6] * __v12 - __v23 * __v21;
        let __v25 = __v5 * __v22 - __v1 * __v24;
        let __v26 = __links[0][5] + __v4 * __v18;
        let __v27 = __v0 * (__links[0][8] * __v12 - __v26 * __v21);
        let __v28 = __v3 * (__sin_cos[0][1] * __v22 - __sin_cos[0][0] * __v24) - __v27;
        let __v29 = __v15 * __v20;
        let __v30 = __links[0][1] * __v12 - __v19 * __v29;
        let __v31 = __links[0][0] * __v12 - __v23 * __v29;
        let __v32 = __v5 * __v30 - __v1 * __v31;
        let __v33 = __v0 * (__links[0][2] * __v12 - __v26 * __v29);
        let __v34 = __v3 * (__sin_cos[0][1] * __v30 - __sin_cos[0][0] * __v31) - __v33;
        [__v14, __v16, __v25, __v28, __v32, __v34]
    }
    #[allow(
        dead_code,
        unreachable_pub,
        reason = "they were asked for, and may be called in one build only"
    )]
    impl Extra {
        ///Aim of joint `head`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
        /// Zeros where there is no such joint.
        #[inline]
        pub fn aim_gradient<S: ::aim::__private::Scalar>(
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[S; 12],
            __target: &[S; 3],
            __sin_cos: &[S; 4],
        ) -> [S; 3] {
            match __joint {
                0 => aim_gradient_0(__effector_to_joint, __target, __sin_cos),
                _ => [<S as ::aim::__private::Scalar>::ZERO; 3],
            }
        }
        ///The chain's aim, then its 2 derivatives, pitch before heading, joint by joint. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
        /// Slices of other lengths give zeros.
        #[inline]
        pub fn chain_value_gradient<S: ::aim::__private::Scalar>(
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
                <&[[S; 12]; 1] as ::core::convert::TryFrom<
                    &[[S; 12]],
                >>::try_from(__links),
                <&[[S; 4]; 1] as ::core::convert::TryFrom<
                    &[[S; 4]],
                >>::try_from(__sin_cos),
                <&mut [S; 3] as ::core::convert::TryFrom<
                    &mut [S],
                >>::try_from(&mut *__out),
            ) {
                *__out = chain_value_gradient(__links, __target, __sin_cos);
            } else {
                <[S]>::fill(__out, <S as ::aim::__private::Scalar>::ZERO);
            }
        }
        ///The chain's stereographic residual (left, up), then the 2 derivatives of the first and of the second. 87 operations: 31 add, 53 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Extra`.
        /// Slices of other lengths give zeros.
        #[inline]
        pub fn chain_residual_jacobian<S: ::aim::__private::Scalar>(
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
                <&[[S; 12]; 1] as ::core::convert::TryFrom<
                    &[[S; 12]],
                >>::try_from(__links),
                <&[[S; 4]; 1] as ::core::convert::TryFrom<
                    &[[S; 4]],
                >>::try_from(__sin_cos),
                <&mut [S; 6] as ::core::convert::TryFrom<
                    &mut [S],
                >>::try_from(&mut *__out),
            ) {
                *__out = chain_residual_jacobian(__links, __target, __sin_cos);
            } else {
                <[S]>::fill(__out, <S as ::aim::__private::Scalar>::ZERO);
            }
        }
    }
};

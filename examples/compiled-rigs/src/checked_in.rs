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
    ///Moves the bone `neck`.
    pub neck: ::aim::Joint,
}
///A value for each joint of [`Extra`]: its pose, corrections, or anything else that is wanted by name.
#[allow(dead_code, reason = "a rig may be used without it")]
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub struct ExtraPose<T = ::aim::__private::Affine3A> {
    ///Of the joint `head`.
    pub head: T,
    ///Of the joint `neck`.
    pub neck: T,
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
                1 => ::core::option::Option::Some("neck"),
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
                (1, 0) => ::core::option::Option::Some("neck"),
                _ => ::core::option::Option::None,
            }
        }
        ///The chain's stereographic residual (left, up), then the 4 derivatives of the first and of the second. 183 operations: 68 add, 112 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Extra`.
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
                __link_1,
                ],
                [__sin_cos_0,
                __sin_cos_1,
                ],
                [__out_0,
                __out_1,
                __out_2,
                __out_3,
                __out_4,
                __out_5,
                __out_6,
                __out_7,
                __out_8,
                __out_9,
                ],
            ) = (__links, __sin_cos, &mut *__out) else {
                return <[::core::primitive::f32]>::fill(__out, 0.0);
            };
            let __v0 = __target[1] * __sin_cos_1[3] + __target[2] * __sin_cos_1[2];
            let __v1 = __target[0] * __sin_cos_1[1] - __sin_cos_1[0] * __v0;
            let __v2 = __v1 - __link_1[9];
            let __v3 = __sin_cos_1[1] * __v0 + __target[0] * __sin_cos_1[0];
            let __v4 = __v3 - __link_1[10];
            let __v5 = __target[2] * __sin_cos_1[3] - __target[1] * __sin_cos_1[2];
            let __v6 = __v5 - __link_1[11];
            let __v7 = __link_1[3] * __v2 + __link_1[4] * __v4 + __link_1[5] * __v6;
            let __v8 = __link_1[6] * __v2 + __link_1[7] * __v4 + __link_1[8] * __v6;
            let __v9 = __sin_cos_0[3] * __v7 + __sin_cos_0[2] * __v8;
            let __v10 = __link_1[0] * __v2 + __link_1[1] * __v4 + __link_1[2] * __v6;
            let __v11 = __sin_cos_0[1] * __v9 + __sin_cos_0[0] * __v10;
            let __v12 = __v11 - __link_0[10];
            let __v13 = __sin_cos_0[3] * __v8 - __sin_cos_0[2] * __v7;
            let __v14 = __v13 - __link_0[11];
            let __v15 = __sin_cos_0[1] * __v10 - __sin_cos_0[0] * __v9;
            let __v16 = __v15 - __link_0[9];
            let __v17 = __v12 * __v12 + __v14 * __v14 + __v16 * __v16;
            let __v18 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                __v17,
            );
            let __v19 = __v18
                + (__link_0[3] * __v16 + __link_0[4] * __v12 + __link_0[5] * __v14);
            let __v20 = 1.0 / __v19;
            let __v21 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v19
            {
                __v20
            } else {
                0.0
            };
            let __v22 = 2.0 * __v21;
            let __v23 = __link_0[6] * __v16 + __link_0[7] * __v12 + __link_0[8] * __v14;
            let __v24 = __v22 * __v23;
            *__out_0 = __v24;
            let __v25 = __link_0[0] * __v16 + __link_0[1] * __v12 + __link_0[2] * __v14;
            let __v26 = __v22 * __v25;
            *__out_1 = __v26;
            let __v27 = 1.0 / __v18;
            let __v28 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v18
            {
                __v27
            } else {
                0.0
            };
            let __v29 = __link_0[4] + __v12 * __v28;
            let __v30 = __v21 * __v22;
            let __v31 = __v23 * __v30;
            let __v32 = __link_0[7] * __v22 - __v29 * __v31;
            let __v33 = __link_0[3] + __v16 * __v28;
            let __v34 = __link_0[6] * __v22 - __v33 * __v31;
            let __v35 = __v15 * __v32 - __v11 * __v34;
            *__out_2 = __v35;
            let __v36 = __sin_cos_0[1] * __v32 - __sin_cos_0[0] * __v34;
            let __v37 = __link_0[5] + __v14 * __v28;
            let __v38 = __link_0[8] * __v22 - __v37 * __v31;
            let __v39 = __v13 * __v36 - __v9 * __v38;
            *__out_3 = __v39;
            let __v40 = __sin_cos_0[0] * __v32 + __sin_cos_0[1] * __v34;
            let __v41 = __sin_cos_0[3] * __v36 - __sin_cos_0[2] * __v38;
            let __v42 = __sin_cos_0[2] * __v36 + __sin_cos_0[3] * __v38;
            let __v43 = __link_1[1] * __v40 + __link_1[4] * __v41 + __link_1[7] * __v42;
            let __v44 = __link_1[0] * __v40 + __link_1[3] * __v41 + __link_1[6] * __v42;
            let __v45 = __v1 * __v43 - __v3 * __v44;
            *__out_4 = __v45;
            let __v46 = __v0
                * (__link_1[2] * __v40 + __link_1[5] * __v41 + __link_1[8] * __v42);
            let __v47 = __v5 * (__sin_cos_1[1] * __v43 - __sin_cos_1[0] * __v44) - __v46;
            *__out_5 = __v47;
            let __v48 = __v25 * __v30;
            let __v49 = __link_0[1] * __v22 - __v29 * __v48;
            let __v50 = __link_0[0] * __v22 - __v33 * __v48;
            let __v51 = __v15 * __v49 - __v11 * __v50;
            *__out_6 = __v51;
            let __v52 = __sin_cos_0[1] * __v49 - __sin_cos_0[0] * __v50;
            let __v53 = __link_0[2] * __v22 - __v37 * __v48;
            let __v54 = __v13 * __v52 - __v9 * __v53;
            *__out_7 = __v54;
            let __v55 = __sin_cos_0[0] * __v49 + __sin_cos_0[1] * __v50;
            let __v56 = __sin_cos_0[3] * __v52 - __sin_cos_0[2] * __v53;
            let __v57 = __sin_cos_0[2] * __v52 + __sin_cos_0[3] * __v53;
            let __v58 = __link_1[1] * __v55 + __link_1[4] * __v56 + __link_1[7] * __v57;
            let __v59 = __link_1[0] * __v55 + __link_1[3] * __v56 + __link_1[6] * __v57;
            let __v60 = __v1 * __v58 - __v3 * __v59;
            *__out_8 = __v60;
            let __v61 = __v0
                * (__link_1[2] * __v55 + __link_1[5] * __v56 + __link_1[8] * __v57);
            let __v62 = __v5 * (__sin_cos_1[1] * __v58 - __sin_cos_1[0] * __v59) - __v61;
            *__out_9 = __v62;
        }
        ///Aim of joint `head`, `neck`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
        fn aim_gradient(
            &self,
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[::core::primitive::f32; 12],
            __target: &[::core::primitive::f32; 3],
            __sin_cos: &[::core::primitive::f32; 4],
        ) -> [::core::primitive::f32; 3] {
            match __joint {
                0 | 1 => {
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
        type Array<T: ::core::marker::Copy> = [T; 2];
        const RIG: &'static Self = &Self {
            head: ::aim::__private::Joint::REST,
            neck: ::aim::__private::Joint::REST,
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
                        .with_heading(-0.7853982, 0.7853982)
                        .with_pitch(-0.43633232, 0.43633232)
                        .with_stiffness(1.0)
                        .with_role(::aim::__private::Role::Head),
                    ::aim::__private::JointInfo::new(
                            ::aim::__private::Axes {
                                up: [1.0, 0.0, 0.0],
                                forward: [0.0, 1.0, 0.0],
                                left: [0.0, 0.0, 1.0],
                            },
                            2.9670596,
                        )
                        .with_heading(-0.61086524, 0.61086524)
                        .with_pitch(-0.34906584, 0.34906584)
                        .with_stiffness(2.0)
                        .with_role(::aim::__private::Role::Neck),
                ],
            )
            .with_effector(::aim::__private::Effector {
                forward: [0.0, 1.0, 0.0],
                origin: [0.09, 0.09, 0.0],
            });
        #[inline]
        fn array<T: ::core::marker::Copy>(__value: T) -> [T; 2] {
            [__value; 2]
        }
        #[inline]
        fn from_joints([__joint_0, __joint_1]: [::aim::__private::Joint; 2]) -> Self {
            Self {
                head: __joint_0,
                neck: __joint_1,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<Extra> for [::aim::__private::Joint; 2] {
        #[inline]
        fn from(__value: Extra) -> Self {
            [__value.head, __value.neck]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<ExtraPose<T>> for [T; 2] {
        #[inline]
        fn from(__pose: ExtraPose<T>) -> Self {
            [__pose.head, __pose.neck]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<[T; 2]> for ExtraPose<T> {
        #[inline]
        fn from([__joint_0, __joint_1]: [T; 2]) -> Self {
            Self {
                head: __joint_0,
                neck: __joint_1,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<ExtraPose>
    for ::aim::__private::Pose<[::aim::__private::Affine3A; 2]> {
        #[inline]
        fn from(__pose: ExtraPose) -> Self {
            <Self>::new(::core::convert::Into::into(__pose))
        }
    }
    ///Aim of joint `head`, `neck`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
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
    ///The chain's aim, then its 4 derivatives, pitch before heading, joint by joint. 110 operations: 42 add, 66 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
    #[inline]
    fn chain_value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 5] {
        let __v0 = __target[1] * __sin_cos[1][3] + __target[2] * __sin_cos[1][2];
        let __v1 = __target[0] * __sin_cos[1][1] - __sin_cos[1][0] * __v0;
        let __v2 = __v1 - __links[1][9];
        let __v3 = __sin_cos[1][1] * __v0 + __target[0] * __sin_cos[1][0];
        let __v4 = __v3 - __links[1][10];
        let __v5 = __target[2] * __sin_cos[1][3] - __target[1] * __sin_cos[1][2];
        let __v6 = __v5 - __links[1][11];
        let __v7 = __links[1][3] * __v2 + __links[1][4] * __v4 + __links[1][5] * __v6;
        let __v8 = __links[1][6] * __v2 + __links[1][7] * __v4 + __links[1][8] * __v6;
        let __v9 = __sin_cos[0][3] * __v7 + __sin_cos[0][2] * __v8;
        let __v10 = __links[1][0] * __v2 + __links[1][1] * __v4 + __links[1][2] * __v6;
        let __v11 = __sin_cos[0][1] * __v10 - __sin_cos[0][0] * __v9;
        let __v12 = __v11 - __links[0][9];
        let __v13 = __sin_cos[0][1] * __v9 + __sin_cos[0][0] * __v10;
        let __v14 = __v13 - __links[0][10];
        let __v15 = __sin_cos[0][3] * __v8 - __sin_cos[0][2] * __v7;
        let __v16 = __v15 - __links[0][11];
        let __v17 = __v12 * __v12 + __v14 * __v14 + __v16 * __v16;
        let __v18 = <S as ::aim::__private::Scalar>::sqrt(__v17);
        let __v19 = <S as ::aim::__private::Scalar>::constant(1.0) / __v18;
        let __v20 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v18,
            __v19,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v21 = __v20
            * (__links[0][3] * __v12 + __links[0][4] * __v14 + __links[0][5] * __v16);
        let __v22 = __v20 * __v21;
        let __v23 = __v20 * (__links[0][4] - __v14 * __v22);
        let __v24 = __v20 * (__links[0][3] - __v12 * __v22);
        let __v25 = __v11 * __v23 - __v13 * __v24;
        let __v26 = __sin_cos[0][1] * __v23 - __sin_cos[0][0] * __v24;
        let __v27 = __v20 * (__links[0][5] - __v16 * __v22);
        let __v28 = __v15 * __v26 - __v9 * __v27;
        let __v29 = __sin_cos[0][0] * __v23 + __sin_cos[0][1] * __v24;
        let __v30 = __sin_cos[0][3] * __v26 - __sin_cos[0][2] * __v27;
        let __v31 = __sin_cos[0][2] * __v26 + __sin_cos[0][3] * __v27;
        let __v32 = __links[1][1] * __v29 + __links[1][4] * __v30
            + __links[1][7] * __v31;
        let __v33 = __links[1][0] * __v29 + __links[1][3] * __v30
            + __links[1][6] * __v31;
        let __v34 = __v1 * __v32 - __v3 * __v33;
        let __v35 = __v0
            * (__links[1][2] * __v29 + __links[1][5] * __v30 + __links[1][8] * __v31);
        let __v36 = __v5 * (__sin_cos[1][1] * __v32 - __sin_cos[1][0] * __v33) - __v35;
        [__v21, __v25, __v28, __v34, __v36]
    }
    ///The chain's stereographic residual (left, up), then the 4 derivatives of the first and of the second. 183 operations: 68 add, 112 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Extra`.
    #[inline]
    fn chain_residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 10] {
        let __v0 = __target[1] * __sin_cos[1][3] + __target[2] * __sin_cos[1][2];
        let __v1 = __target[0] * __sin_cos[1][1] - __sin_cos[1][0] * __v0;
        let __v2 = __v1 - __links[1][9];
        let __v3 = __sin_cos[1][1] * __v0 + __target[0] * __sin_cos[1][0];
        let __v4 = __v3 - __links[1][10];
        let __v5 = __target[2] * __sin_cos[1][3] - __target[1] * __sin_cos[1][2];
        let __v6 = __v5 - __links[1][11];
        let __v7 = __links[1][3] * __v2 + __links[1][4] * __v4 + __links[1][5] * __v6;
        let __v8 = __links[1][6] * __v2 + __links[1][7] * __v4 + __links[1][8] * __v6;
        let __v9 = __sin_cos[0][3] * __v7 + __sin_cos[0][2] * __v8;
        let __v10 = __links[1][0] * __v2 + __links[1][1] * __v4 + __links[1][2] * __v6;
        let __v11 = __sin_cos[0][1] * __v9 + __sin_cos[0][0] * __v10;
        let __v12 = __v11 - __links[0][10];
        let __v13 = __sin_cos[0][3] * __v8 - __sin_cos[0][2] * __v7;
        let __v14 = __v13 - __links[0][11];
        let __v15 = __sin_cos[0][1] * __v10 - __sin_cos[0][0] * __v9;
        let __v16 = __v15 - __links[0][9];
        let __v17 = __v12 * __v12 + __v14 * __v14 + __v16 * __v16;
        let __v18 = <S as ::aim::__private::Scalar>::sqrt(__v17);
        let __v19 = __v18
            + (__links[0][3] * __v16 + __links[0][4] * __v12 + __links[0][5] * __v14);
        let __v20 = <S as ::aim::__private::Scalar>::constant(1.0) / __v19;
        let __v21 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v19,
            __v20,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v22 = <S as ::aim::__private::Scalar>::constant(2.0) * __v21;
        let __v23 = __links[0][6] * __v16 + __links[0][7] * __v12
            + __links[0][8] * __v14;
        let __v24 = __v22 * __v23;
        let __v25 = __links[0][0] * __v16 + __links[0][1] * __v12
            + __links[0][2] * __v14;
        let __v26 = __v22 * __v25;
        let __v27 = <S as ::aim::__private::Scalar>::constant(1.0) / __v18;
        let __v28 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v18,
            __v27,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v29 = __links[0][4] + __v12 * __v28;
        let __v30 = __v21 * __v22;
        let __v31 = __v23 * __v30;
        let __v32 = __links[0][7] * __v22 - __v29 * __v31;
        let __v33 = __links[0][3] + __v16 * __v28;
        let __v34 = __links[0][6] * __v22 - __v33 * __v31;
        let __v35 = __v15 * __v32 - __v11 * __v34;
        let __v36 = __sin_cos[0][1] * __v32 - __sin_cos[0][0] * __v34;
        let __v37 = __links[0][5] + __v14 * __v28;
        let __v38 = __links[0][8] * __v22 - __v37 * __v31;
        let __v39 = __v13 * __v36 - __v9 * __v38;
        let __v40 = __sin_cos[0][0] * __v32 + __sin_cos[0][1] * __v34;
        let __v41 = __sin_cos[0][3] * __v36 - __sin_cos[0][2] * __v38;
        let __v42 = __sin_cos[0][2] * __v36 + __sin_cos[0][3] * __v38;
        let __v43 = __links[1][1] * __v40 + __links[1][4] * __v41
            + __links[1][7] * __v42;
        let __v44 = __links[1][0] * __v40 + __links[1][3] * __v41
            + __links[1][6] * __v42;
        let __v45 = __v1 * __v43 - __v3 * __v44;
        let __v46 = __v0
            * (__links[1][2] * __v40 + __links[1][5] * __v41 + __links[1][8] * __v42);
        let __v47 = __v5 * (__sin_cos[1][1] * __v43 - __sin_cos[1][0] * __v44) - __v46;
        let __v48 = __v25 * __v30;
        let __v49 = __links[0][1] * __v22 - __v29 * __v48;
        let __v50 = __links[0][0] * __v22 - __v33 * __v48;
        let __v51 = __v15 * __v49 - __v11 * __v50;
        let __v52 = __sin_cos[0][1] * __v49 - __sin_cos[0][0] * __v50;
        let __v53 = __links[0][2] * __v22 - __v37 * __v48;
        let __v54 = __v13 * __v52 - __v9 * __v53;
        let __v55 = __sin_cos[0][0] * __v49 + __sin_cos[0][1] * __v50;
        let __v56 = __sin_cos[0][3] * __v52 - __sin_cos[0][2] * __v53;
        let __v57 = __sin_cos[0][2] * __v52 + __sin_cos[0][3] * __v53;
        let __v58 = __links[1][1] * __v55 + __links[1][4] * __v56
            + __links[1][7] * __v57;
        let __v59 = __links[1][0] * __v55 + __links[1][3] * __v56
            + __links[1][6] * __v57;
        let __v60 = __v1 * __v58 - __v3 * __v59;
        let __v61 = __v0
            * (__links[1][2] * __v55 + __links[1][5] * __v56 + __links[1][8] * __v57);
        let __v62 = __v5 * (__sin_cos[1][1] * __v58 - __sin_cos[1][0] * __v59) - __v61;
        [__v24, __v26, __v35, __v39, __v45, __v47, __v51, __v54, __v60, __v62]
    }
    #[allow(
        dead_code,
        unreachable_pub,
        reason = "they were asked for, and may be called in one build only"
    )]
    impl Extra {
        ///Aim of joint `head`, `neck`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
        /// Zeros where there is no such joint.
        #[inline]
        pub fn aim_gradient<S: ::aim::__private::Scalar>(
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[S; 12],
            __target: &[S; 3],
            __sin_cos: &[S; 4],
        ) -> [S; 3] {
            match __joint {
                0 | 1 => aim_gradient_0(__effector_to_joint, __target, __sin_cos),
                _ => [<S as ::aim::__private::Scalar>::ZERO; 3],
            }
        }
        ///The chain's aim, then its 4 derivatives, pitch before heading, joint by joint. 110 operations: 42 add, 66 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
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
                *__out = chain_value_gradient(__links, __target, __sin_cos);
            } else {
                <[S]>::fill(__out, <S as ::aim::__private::Scalar>::ZERO);
            }
        }
        ///The chain's stereographic residual (left, up), then the 4 derivatives of the first and of the second. 183 operations: 68 add, 112 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Extra`.
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
                *__out = chain_residual_jacobian(__links, __target, __sin_cos);
            } else {
                <[S]>::fill(__out, <S as ::aim::__private::Scalar>::ZERO);
            }
        }
    }
};

// What the derive makes of a declaration in tests/src/declarations.rs; rewritten by
// AIM_BLESS=1 cargo test -p aim-tests --test it golden
///A value for each joint of [`General`]: its pose, corrections, or anything else that is wanted by name.
#[allow(dead_code, reason = "a rig may be used without it")]
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub struct GeneralPose<T = ::aim::__private::Affine3A> {
    ///Of the joint `left_eye`.
    pub left_eye: T,
    ///Of the joint `r#neck`.
    pub r#neck: T,
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
    impl ::aim::__private::Rig for General {
        #[inline]
        fn description(&self) -> ::aim::__private::Description<'_> {
            *<Self as ::aim::__private::AimRig>::DESCRIPTION
        }
        fn joint_name(
            &self,
            __joint: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match __joint {
                0 => ::core::option::Option::Some("left_eye"),
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
                (0, 0) => ::core::option::Option::Some("L_eye"),
                (0, 1) => ::core::option::Option::Some("LeftEye"),
                (1, 0) => ::core::option::Option::Some("neck"),
                _ => ::core::option::Option::None,
            }
        }
        fn held_bone(
            &self,
            __joint: ::core::primitive::usize,
            __candidate: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match (__joint, __candidate) {
                (1, 0) => ::core::option::Option::Some("L_clavicle"),
                (1, 1) => ::core::option::Option::Some("R_clavicle"),
                _ => ::core::option::Option::None,
            }
        }
        fn other_eye_bone(&self) -> ::core::option::Option<&::core::primitive::str> {
            ::core::option::Option::Some("R_eye")
        }
        ///The chain's stereographic residual (left, up), then the 4 derivatives of the first and of the second. 213 operations: 80 add, 130 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `General`.
        #[inline(always)]
        fn residual_jacobian(
            &self,
            __links: &[[::core::primitive::f32; 12]],
            __target: &[::core::primitive::f32; 3],
            __sin_cos: &[[::core::primitive::f32; 4]],
            __out: &mut [::core::primitive::f32],
        ) {
            let (
                [_,
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
            let __v0 = __target[0] * __sin_cos_1[3] + __target[1] * __sin_cos_1[2];
            let __v1 = __sin_cos_1[1] * __v0 - __target[2] * __sin_cos_1[0];
            let __v2 = __link_1[9] - __v1;
            let __v3 = __target[0] * __sin_cos_1[2] - __target[1] * __sin_cos_1[3];
            let __v4 = __v3 + __link_1[10];
            let __v5 = __sin_cos_1[0] * __v0 + __target[2] * __sin_cos_1[1];
            let __v6 = __link_1[11] - __v5;
            let __v7 = __link_1[3] * __v2 + __link_1[4] * __v4 + __link_1[5] * __v6;
            let __v8 = __link_1[6] * __v2 + __link_1[7] * __v4 + __link_1[8] * __v6;
            let __v9 = __v8 * 0.96 - 0.28 * __v7;
            let __v10 = __sin_cos_0[2] * 2.142857 - __sin_cos_0[3] * 2.857143;
            let __v11 = __link_1[0] * __v2 + __link_1[1] * __v4 + __link_1[2] * __v6;
            let __v12 = __v8 + __v7 * 3.4285715;
            let __v13 = __v11 + __v12 * 0.000000000000000006217249;
            let __v14 = __sin_cos_0[2] * 2.857143 + __sin_cos_0[3] * 2.142857;
            let __v15 = __v13 * __v14 - __v9 * __v10;
            let __v16 = __v11 * 0.00000000000000005947623 - __v12;
            let __v17 = __sin_cos_0[1] * __v15 - __sin_cos_0[0] * __v16;
            let __v18 = __v9 * __v14 + __v10 * __v13;
            let __v19 = __v18 * 0.8333333 - __v17 * 0.625;
            let __v20 = __v2 * __v2 + __v4 * __v4 + __v6 * __v6;
            let __v21 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                __v20,
            );
            let __v22 = __sin_cos_0[0] * __v15 + __sin_cos_0[1] * __v16;
            let __v23 = __v21 - (__v17 * 0.21504 + __v18 * 0.16128 - __v22 * 0.0784);
            let __v24 = 0.21504 / __v23;
            let __v25 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v23
            {
                __v24
            } else {
                0.0
            };
            let __v26 = __v25 * 2.5;
            let __v27 = __v19 * __v26;
            *__out_0 = __v27;
            let __v28 = __v22 + (__v17 * 0.23333333 + __v18 * 0.175);
            let __v29 = __v28 * __v26;
            *__out_1 = __v29;
            let __v30 = __v25 * __v26;
            let __v31 = __v19 * __v30;
            let __v32 = 0.625 * __v26 - __v31;
            let __v33 = 0.36458334 * __v31;
            let __v34 = __v22 * __v32 - __v17 * __v33;
            *__out_2 = __v34;
            let __v35 = __sin_cos_0[1] * __v32 + __sin_cos_0[0] * __v33;
            let __v36 = 0.8333333 * __v26 + 0.75 * __v31;
            let __v37 = __v18 * __v35 + __v15 * __v36;
            *__out_3 = __v37;
            let __v38 = __v14 * __v35 - __v10 * __v36;
            let __v39 = __sin_cos_0[0] * __v32 - __sin_cos_0[1] * __v33;
            let __v40 = __v38 - 0.00000000000000005947623 * __v39;
            let __v41 = __v39 + 0.0000000000000000046629366 * __v38;
            let __v42 = __v10 * __v35 + __v14 * __v36;
            let __v43 = 3.4285715 * __v41 + 0.28 * __v42;
            let __v44 = __v41 - 0.96 * __v42;
            let __v45 = 4.6502976 / __v21;
            let __v46 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v21
            {
                __v45
            } else {
                0.0
            };
            let __v47 = __v46 * __v31;
            let __v48 = __v2 * __v47;
            let __v49 = __link_1[0] * __v40 + __link_1[3] * __v43 + __link_1[6] * __v44
                + __v48;
            let __v50 = __v6 * __v47;
            let __v51 = __link_1[2] * __v40 + __link_1[5] * __v43 + __link_1[8] * __v44
                + __v50;
            let __v52 = __v1 * __v51 - __v5 * __v49;
            *__out_4 = __v52;
            let __v53 = __v4 * __v47;
            let __v54 = __link_1[1] * __v40 + __link_1[4] * __v43 + __link_1[7] * __v44
                + __v53;
            let __v55 = __v3 * (__sin_cos_1[1] * __v49 + __sin_cos_1[0] * __v51)
                + __v0 * __v54;
            let __v56 = __v28 * __v30;
            let __v57 = 0.23333333 * __v26 + __v56;
            let __v58 = __v26 - 0.36458334 * __v56;
            let __v59 = __v17 * __v58 - __v22 * __v57;
            *__out_6 = __v59;
            let __v60 = __sin_cos_0[1] * __v57 + __sin_cos_0[0] * __v58;
            let __v61 = 0.175 * __v26 + 0.75 * __v56;
            let __v62 = __v15 * __v61 - __v18 * __v60;
            *__out_7 = __v62;
            let __v63 = __v14 * __v60 + __v10 * __v61;
            let __v64 = __sin_cos_0[0] * __v57 - __sin_cos_0[1] * __v58;
            let __v65 = __v63 - 0.00000000000000005947623 * __v64;
            let __v66 = __v64 + 0.0000000000000000046629366 * __v63;
            let __v67 = __v14 * __v61 - __v10 * __v60;
            let __v68 = 3.4285715 * __v66 - 0.28 * __v67;
            let __v69 = __v66 + 0.96 * __v67;
            let __v70 = __v46 * __v56;
            let __v71 = __v2 * __v70;
            let __v72 = __link_1[0] * __v65 + __link_1[3] * __v68 + __link_1[6] * __v69
                - __v71;
            let __v73 = __v6 * __v70;
            let __v74 = __link_1[2] * __v65 + __link_1[5] * __v68 + __link_1[8] * __v69
                - __v73;
            let __v75 = __v5 * __v72 - __v1 * __v74;
            *__out_8 = __v75;
            let __v76 = __v4 * __v70;
            let __v77 = __link_1[1] * __v65 + __link_1[4] * __v68 + __link_1[7] * __v69
                - __v76;
            let __v78 = __v3 * (__sin_cos_1[1] * __v72 + __sin_cos_1[0] * __v74)
                + __v0 * __v77;
            *__out_5 = -__v55;
            *__out_9 = __v78;
        }
        ///Aim of joint `left_eye`, d aim / d pitch, d aim / d heading. 86 operations: 33 add, 51 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `General`.
        ///Aim of joint `neck`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `General`.
        fn aim_gradient(
            &self,
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[::core::primitive::f32; 12],
            __target: &[::core::primitive::f32; 3],
            __sin_cos: &[::core::primitive::f32; 4],
        ) -> [::core::primitive::f32; 3] {
            match __joint {
                0 => {
                    let __v0 = __target[1] * 0.28 - __target[2] * 0.96;
                    let __v1 = __sin_cos[2] * 0.768 + __sin_cos[3] * 0.576;
                    let __v2 = __target[1] * 0.9216 + __target[2] * 0.2688;
                    let __v3 = __target[0] + __v2 * 0.000000000000000023129646;
                    let __v4 = __sin_cos[3] * 0.768 - __sin_cos[2] * 0.576;
                    let __v5 = __v0 * __v1 + __v3 * __v4;
                    let __v6 = __v0 * __v4 - __v1 * __v3;
                    let __v7 = __sin_cos[0] + __sin_cos[1] * 0.23333333;
                    let __v8 = __v2 - __target[0] * 0.000000000000000015987211;
                    let __v9 = __sin_cos[1] - __sin_cos[0] * 0.23333333;
                    let __v10 = __v6 * __v7 + __v8 * __v9;
                    let __v11 = __v10 * 0.16596417 - __v5;
                    let __v12 = __v7 * __v8 - __v6 * __v9;
                    let __v13 = __v12 * 0.5927292 - __v11 * 0.8333333
                        - __effector_to_joint[9];
                    let __v14 = __v10 + __v5 * 0.175 - __effector_to_joint[10];
                    let __v15 = __v11 * 0.6 + __v12 * 0.823235 - __effector_to_joint[11];
                    let __v16 = __v13 * __v13 + __v14 * __v14 + __v15 * __v15;
                    let __v17 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                        __v16,
                    );
                    let __v18 = 1.0 / __v17;
                    let __v19 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                        < __v17
                    {
                        __v18
                    } else {
                        0.0
                    };
                    let __v20 = __v19
                        * (__effector_to_joint[6] * __v13
                            + __effector_to_joint[7] * __v14
                            + __effector_to_joint[8] * __v15);
                    let __v21 = __v19 * __v20;
                    let __v22 = __effector_to_joint[8] - __v15 * __v21;
                    let __v23 = __effector_to_joint[6] - __v13 * __v21;
                    let __v24 = 0.823235 * __v22 + 0.5927292 * __v23;
                    let __v25 = __effector_to_joint[7] - __v14 * __v21;
                    let __v26 = 0.6 * __v22 - 0.8333333 * __v23;
                    let __v27 = __v25 + __v26 * 0.16596417;
                    let __v28 = __v19 * (__v10 * __v24 - __v12 * __v27);
                    let __v29 = __v6 * (__v26 - 0.175 * __v25);
                    let __v30 = __v19 * (__v5 * (__v9 * __v24 - __v7 * __v27) - __v29);
                    [__v20, __v28, __v30]
                }
                1 => {
                    let __v0 = __target[0] * __sin_cos[3] + __target[1] * __sin_cos[2];
                    let __v1 = __sin_cos[1] * __v0 - __target[2] * __sin_cos[0];
                    let __v2 = __v1 - __effector_to_joint[9];
                    let __v3 = __target[1] * __sin_cos[3] - __target[0] * __sin_cos[2];
                    let __v4 = __v3 - __effector_to_joint[10];
                    let __v5 = __sin_cos[0] * __v0 + __target[2] * __sin_cos[1];
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
                _ => [0.0, 0.0, 0.0],
            }
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for General {
        type Array<T: ::core::marker::Copy> = [T; 2];
        const RIG: &'static Self = &Self {
            left_eye: ::aim::__private::Joint::REST,
            r#neck: ::aim::__private::Joint::REST,
        };
        const DESCRIPTION: &'static ::aim::__private::Description<'static> = &::aim::__private::Description::new(
                &[
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
                        .with_stiffness(0.5)
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
                        .with_stiffness(1.0)
                        .with_upright(0.5)
                        .with_pitch_taper(0.25)
                        .with_role(::aim::__private::Role::Neck)
                        .with_limits_from(::aim::__private::LimitsFrom::BindPose),
                ],
            )
            .with_effector(::aim::__private::Effector {
                forward: [0.0, 0.0, 1.0],
                origin: [0.0, 0.0, 0.0],
            })
            .with_sharing(
                ::aim::__private::GazeSharing::HUMAN
                    .with_eyes_only(0.17453292)
                    .with_head_share(0.7)
                    .with_engagement(0.25, 0.08726646)
                    .with_delay(0.05),
            );
        #[inline]
        fn array<T: ::core::marker::Copy>(__value: T) -> [T; 2] {
            [__value; 2]
        }
        #[inline]
        fn from_joints([__joint_0, __joint_1]: [::aim::__private::Joint; 2]) -> Self {
            Self {
                left_eye: __joint_0,
                r#neck: __joint_1,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<General> for [::aim::__private::Joint; 2] {
        #[inline]
        fn from(__value: General) -> Self {
            [__value.left_eye, __value.r#neck]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<GeneralPose<T>> for [T; 2] {
        #[inline]
        fn from(__pose: GeneralPose<T>) -> Self {
            [__pose.left_eye, __pose.r#neck]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<[T; 2]> for GeneralPose<T> {
        #[inline]
        fn from([__joint_0, __joint_1]: [T; 2]) -> Self {
            Self {
                left_eye: __joint_0,
                r#neck: __joint_1,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<GeneralPose>
    for ::aim::__private::Pose<[::aim::__private::Affine3A; 2]> {
        #[inline]
        fn from(__pose: GeneralPose) -> Self {
            <Self>::new(::core::convert::Into::into(__pose))
        }
    }
};

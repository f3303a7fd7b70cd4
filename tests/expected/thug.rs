// What the derive makes of a declaration in tests/src/declarations.rs; rewritten by
// AIM_BLESS=1 cargo test -p aim-tests --test it golden
///A value for each joint of [`Thug`]: its pose, corrections, or anything else that is wanted by name.
#[allow(dead_code, reason = "a rig may be used without it")]
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub struct ThugPose<T = ::aim::__private::Affine3A> {
    ///Of the joint `left_eye`.
    pub left_eye: T,
    ///Of the joint `neck`.
    pub neck: T,
    ///Of the joint `spine3`.
    pub spine3: T,
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
    impl ::aim::__private::Rig for Thug {
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
                2 => ::core::option::Option::Some("spine3"),
                _ => ::core::option::Option::None,
            }
        }
        fn bone_name(
            &self,
            __joint: ::core::primitive::usize,
            __candidate: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match (__joint, __candidate) {
                (0, 0) => ::core::option::Option::Some("left_eye"),
                (1, 0) => ::core::option::Option::Some("neck"),
                (2, 0) => ::core::option::Option::Some("spine3"),
                _ => ::core::option::Option::None,
            }
        }
        ///The chain's stereographic residual (left, up), then the 6 derivatives of the first and of the second. 239 operations: 87 add, 149 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Thug`.
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
                __link_2,
                ],
                [__sin_cos_0,
                __sin_cos_1,
                __sin_cos_2,
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
                __out_10,
                __out_11,
                __out_12,
                __out_13,
                ],
            ) = (__links, __sin_cos, &mut *__out) else {
                return <[::core::primitive::f32]>::fill(__out, 0.0);
            };
            let __v0 = __target[1] * __sin_cos_2[3] + __target[2] * __sin_cos_2[2];
            let __v1 = __sin_cos_2[0] * __v0 - __target[0] * __sin_cos_2[1];
            let __v2 = __v1 + __link_2[9];
            let __v3 = __sin_cos_2[1] * __v0 + __target[0] * __sin_cos_2[0];
            let __v4 = __link_2[10] - __v3;
            let __v5 = __target[1] * __sin_cos_2[2] - __target[2] * __sin_cos_2[3];
            let __v6 = __v5 + __link_2[11];
            let __v7 = __link_2[3] * __v2 + __link_2[4] * __v4 + __link_2[5] * __v6;
            let __v8 = __link_2[6] * __v2 + __link_2[7] * __v4 + __link_2[8] * __v6;
            let __v9 = __sin_cos_1[3] * __v7 + __sin_cos_1[2] * __v8;
            let __v10 = __link_2[0] * __v2 + __link_2[1] * __v4 + __link_2[2] * __v6;
            let __v11 = __sin_cos_1[0] * __v9 - __sin_cos_1[1] * __v10;
            let __v12 = __link_1[9] - __v11;
            let __v13 = __sin_cos_1[1] * __v9 + __sin_cos_1[0] * __v10;
            let __v14 = __v13 + __link_1[10];
            let __v15 = __sin_cos_1[2] * __v7 - __sin_cos_1[3] * __v8;
            let __v16 = __link_1[11] - __v15;
            let __v17 = __link_1[3] * __v12 + __link_1[4] * __v14 + __link_1[5] * __v16;
            let __v18 = __link_1[6] * __v12 + __link_1[7] * __v14 + __link_1[8] * __v16;
            let __v19 = __sin_cos_0[3] * __v18 - __sin_cos_0[2] * __v17;
            let __v20 = __v14 * __v14 + __v16 * __v16 + __v12 * __v12;
            let __v21 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                __v20,
            );
            let __v22 = __sin_cos_0[3] * __v17 + __sin_cos_0[2] * __v18;
            let __v23 = __link_1[0] * __v12 + __link_1[1] * __v14 + __link_1[2] * __v16;
            let __v24 = __sin_cos_0[1] * __v22 + __sin_cos_0[0] * __v23;
            let __v25 = __v21 - __v24;
            let __v26 = 1.0 / __v25;
            let __v27 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v25
            {
                __v26
            } else {
                0.0
            };
            let __v28 = 2.0 * __v27;
            let __v29 = __v19 * __v28;
            let __v30 = __sin_cos_0[0] * __v22 - __sin_cos_0[1] * __v23;
            let __v31 = __v30 * __v28;
            *__out_1 = __v31;
            let __v32 = __v27 * __v28;
            let __v33 = __v19 * __v32;
            let __v34 = __v30 * __v33;
            *__out_2 = __v34;
            let __v35 = __sin_cos_0[1] * __v33;
            let __v36 = __v22 * __v28 - __v19 * __v35;
            *__out_3 = __v36;
            let __v37 = __sin_cos_0[3] * __v28 + __sin_cos_0[2] * __v35;
            let __v38 = __sin_cos_0[0] * __v33;
            let __v39 = __sin_cos_0[2] * __v28 - __sin_cos_0[3] * __v35;
            let __v40 = 1.0 / __v21;
            let __v41 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v21
            {
                __v40
            } else {
                0.0
            };
            let __v42 = __v41 * __v33;
            let __v43 = __v14 * __v42;
            let __v44 = __link_1[7] * __v37 - (__link_1[4] * __v39 - __link_1[1] * __v38)
                - __v43;
            let __v45 = __v12 * __v42;
            let __v46 = __link_1[6] * __v37 - (__link_1[3] * __v39 - __link_1[0] * __v38)
                - __v45;
            let __v47 = __v11 * __v44 + __v13 * __v46;
            *__out_4 = __v47;
            let __v48 = __sin_cos_1[1] * __v44 - __sin_cos_1[0] * __v46;
            let __v49 = __v16 * __v42;
            let __v50 = __link_1[8] * __v37 - (__link_1[5] * __v39 - __link_1[2] * __v38)
                - __v49;
            let __v51 = __v15 * __v48 + __v9 * __v50;
            *__out_5 = __v51;
            let __v52 = __sin_cos_1[0] * __v44 + __sin_cos_1[1] * __v46;
            let __v53 = __sin_cos_1[3] * __v48 - __sin_cos_1[2] * __v50;
            let __v54 = __sin_cos_1[2] * __v48 + __sin_cos_1[3] * __v50;
            let __v55 = __link_2[1] * __v52 + __link_2[4] * __v53 + __link_2[7] * __v54;
            let __v56 = __link_2[0] * __v52 + __link_2[3] * __v53 + __link_2[6] * __v54;
            let __v57 = __v1 * __v55 + __v3 * __v56;
            let __v58 = __v0
                * (__link_2[2] * __v52 + __link_2[5] * __v53 + __link_2[8] * __v54);
            let __v59 = __v5 * (__sin_cos_2[1] * __v55 - __sin_cos_2[0] * __v56) + __v58;
            let __v60 = __v30 * __v32;
            let __v61 = __v24 * __v28 - __v30 * __v60;
            *__out_8 = __v61;
            let __v62 = __sin_cos_0[0] * __v28 + __sin_cos_0[1] * __v60;
            let __v63 = __v19 * __v62;
            *__out_9 = __v63;
            let __v64 = __sin_cos_0[2] * __v62;
            let __v65 = __sin_cos_0[1] * __v28 - __sin_cos_0[0] * __v60;
            let __v66 = __sin_cos_0[3] * __v62;
            let __v67 = __link_1[7] * __v64
                - (__link_1[1] * __v65 - __link_1[4] * __v66);
            let __v68 = __v41 * __v60;
            let __v69 = __v14 * __v68 - __v67;
            let __v70 = __link_1[6] * __v64
                - (__link_1[0] * __v65 - __link_1[3] * __v66);
            let __v71 = __v12 * __v68 - __v70;
            let __v72 = __v11 * __v69 + __v13 * __v71;
            *__out_10 = __v72;
            let __v73 = __sin_cos_1[1] * __v69 - __sin_cos_1[0] * __v71;
            let __v74 = __link_1[8] * __v64
                - (__link_1[2] * __v65 - __link_1[5] * __v66);
            let __v75 = __v16 * __v68 - __v74;
            let __v76 = __v15 * __v73 + __v9 * __v75;
            *__out_11 = __v76;
            let __v77 = __sin_cos_1[0] * __v69 + __sin_cos_1[1] * __v71;
            let __v78 = __sin_cos_1[2] * __v75 - __sin_cos_1[3] * __v73;
            let __v79 = __sin_cos_1[2] * __v73 + __sin_cos_1[3] * __v75;
            let __v80 = __link_2[4] * __v78 - __link_2[1] * __v77 - __link_2[7] * __v79;
            let __v81 = __link_2[3] * __v78 - __link_2[0] * __v77 - __link_2[6] * __v79;
            let __v82 = __v1 * __v80 + __v3 * __v81;
            *__out_12 = __v82;
            let __v83 = __v0
                * (__link_2[5] * __v78 - __link_2[2] * __v77 - __link_2[8] * __v79);
            let __v84 = __v5 * (__sin_cos_2[1] * __v80 - __sin_cos_2[0] * __v81) + __v83;
            *__out_0 = -__v29;
            *__out_6 = -__v57;
            *__out_7 = -__v59;
            *__out_13 = __v84;
        }
        ///Aim of joint `left_eye`, `neck`, `spine3`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Thug`.
        fn aim_gradient(
            &self,
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[::core::primitive::f32; 12],
            __target: &[::core::primitive::f32; 3],
            __sin_cos: &[::core::primitive::f32; 4],
        ) -> [::core::primitive::f32; 3] {
            match __joint {
                0 | 1 | 2 => {
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
    impl ::aim::__private::AimRig for Thug {
        type Array<T: ::core::marker::Copy> = [T; 3];
        const RIG: &'static Self = &Self {
            left_eye: ::aim::__private::Joint::REST,
            neck: ::aim::__private::Joint::REST,
            spine3: ::aim::__private::Joint::REST,
        };
        const DESCRIPTION: &'static ::aim::__private::Description<'static> = &::aim::__private::Description::new(
                &[
                    ::aim::__private::JointInfo::new(
                            ::aim::__private::Axes {
                                up: [1.0, 0.0, 0.0],
                                forward: [0.0, 1.0, 0.0],
                                left: [0.0, 0.0, 1.0],
                            },
                            7.8539815,
                        )
                        .with_heading(-0.61086524, 0.61086524)
                        .with_pitch(-0.43633232, 0.34906584)
                        .with_stiffness(0.5)
                        .with_role(::aim::__private::Role::Eye),
                    ::aim::__private::JointInfo::new(
                            ::aim::__private::Axes {
                                up: [1.0, 0.0, 0.0],
                                forward: [0.0, 1.0, 0.0],
                                left: [0.0, 0.0, 1.0],
                            },
                            2.9670596,
                        )
                        .with_heading(-1.0471976, 1.0471976)
                        .with_pitch(-0.6981317, 0.61086524)
                        .with_stiffness(1.0)
                        .with_role(::aim::__private::Role::Neck),
                    ::aim::__private::JointInfo::new(
                            ::aim::__private::Axes {
                                up: [1.0, 0.0, 0.0],
                                forward: [0.0, 1.0, 0.0],
                                left: [0.0, 0.0, 1.0],
                            },
                            1.2217305,
                        )
                        .with_heading(-0.34906584, 0.34906584)
                        .with_pitch(-0.17453292, 0.17453292)
                        .with_stiffness(4.0)
                        .with_role(::aim::__private::Role::Chest),
                ],
            )
            .with_effector(::aim::__private::Effector {
                forward: [0.0, 1.0, 0.0],
                origin: [0.0, 0.0, 0.0],
            });
        #[inline]
        fn array<T: ::core::marker::Copy>(__value: T) -> [T; 3] {
            [__value; 3]
        }
        #[inline]
        fn from_joints(
            [__joint_0,
            __joint_1,
            __joint_2,
            ]: [::aim::__private::Joint; 3],
        ) -> Self {
            Self {
                left_eye: __joint_0,
                neck: __joint_1,
                spine3: __joint_2,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<Thug> for [::aim::__private::Joint; 3] {
        #[inline]
        fn from(__value: Thug) -> Self {
            [__value.left_eye, __value.neck, __value.spine3]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<ThugPose<T>> for [T; 3] {
        #[inline]
        fn from(__pose: ThugPose<T>) -> Self {
            [__pose.left_eye, __pose.neck, __pose.spine3]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<[T; 3]> for ThugPose<T> {
        #[inline]
        fn from([__joint_0, __joint_1, __joint_2]: [T; 3]) -> Self {
            Self {
                left_eye: __joint_0,
                neck: __joint_1,
                spine3: __joint_2,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<ThugPose>
    for ::aim::__private::Pose<[::aim::__private::Affine3A; 3]> {
        #[inline]
        fn from(__pose: ThugPose) -> Self {
            <Self>::new(::core::convert::Into::into(__pose))
        }
    }
};

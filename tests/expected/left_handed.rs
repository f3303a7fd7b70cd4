// What the derive makes of a declaration in tests/src/declarations.rs; rewritten by
// AIM_BLESS=1 cargo test -p aim-tests --test it golden
///A value for each joint of [`LeftHanded`]: its pose, corrections, or anything else that is wanted by name.
#[allow(dead_code, reason = "a rig may be used without it")]
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub struct LeftHandedPose<T = ::aim::__private::Affine3A> {
    ///Of the joint `eye`.
    pub eye: T,
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
    impl ::aim::__private::Rig for LeftHanded {
        #[inline]
        fn description(&self) -> ::aim::__private::Description<'_> {
            *<Self as ::aim::__private::AimRig>::DESCRIPTION
        }
        fn joint_name(
            &self,
            __joint: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match __joint {
                0 => ::core::option::Option::Some("eye"),
                1 => ::core::option::Option::Some("head"),
                _ => ::core::option::Option::None,
            }
        }
        fn bone_name(
            &self,
            __joint: ::core::primitive::usize,
            __candidate: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match (__joint, __candidate) {
                (0, 0) => ::core::option::Option::Some("eye"),
                (1, 0) => ::core::option::Option::Some("head"),
                _ => ::core::option::Option::None,
            }
        }
        ///The chain's stereographic residual (left, up), then the 4 derivatives of the first and of the second. 143 operations: 50 add, 90 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `LeftHanded`.
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
            let __v1 = __sin_cos_1[1] * __v0 + __target[2] * __sin_cos_1[0];
            let __v2 = __link_1[9] - __v1;
            let __v3 = __target[1] * __sin_cos_1[3] - __target[0] * __sin_cos_1[2];
            let __v4 = __link_1[10] - __v3;
            let __v5 = __target[2] * __sin_cos_1[1] - __sin_cos_1[0] * __v0;
            let __v6 = __link_1[11] - __v5;
            let __v7 = __link_1[3] * __v2 + __link_1[4] * __v4 + __link_1[5] * __v6;
            let __v8 = __link_1[6] * __v2 + __link_1[7] * __v4 + __link_1[8] * __v6;
            let __v9 = __sin_cos_0[2] * __v7 + __sin_cos_0[3] * __v8;
            let __v10 = __v2 * __v2 + __v4 * __v4 + __v6 * __v6;
            let __v11 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                __v10,
            );
            let __v12 = __sin_cos_0[3] * __v7 - __sin_cos_0[2] * __v8;
            let __v13 = __link_1[0] * __v2 + __link_1[1] * __v4 + __link_1[2] * __v6;
            let __v14 = __sin_cos_0[1] * __v12 + __sin_cos_0[0] * __v13;
            let __v15 = __v11 - __v14;
            let __v16 = 1.0 / __v15;
            let __v17 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v15
            {
                __v16
            } else {
                0.0
            };
            let __v18 = 2.0 * __v17;
            let __v19 = __v9 * __v18;
            *__out_0 = __v19;
            let __v20 = __sin_cos_0[1] * __v13 - __sin_cos_0[0] * __v12;
            let __v21 = __v20 * __v18;
            let __v22 = __v17 * __v18;
            let __v23 = __v9 * __v22;
            let __v24 = __v20 * __v23;
            *__out_2 = __v24;
            let __v25 = __sin_cos_0[1] * __v23;
            let __v26 = __v12 * __v18 - __v9 * __v25;
            *__out_3 = __v26;
            let __v27 = __sin_cos_0[0] * __v23;
            let __v28 = __sin_cos_0[2] * __v18 + __sin_cos_0[3] * __v25;
            let __v29 = __sin_cos_0[3] * __v18 - __sin_cos_0[2] * __v25;
            let __v30 = 1.0 / __v11;
            let __v31 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v11
            {
                __v30
            } else {
                0.0
            };
            let __v32 = __v31 * __v23;
            let __v33 = __v2 * __v32;
            let __v34 = __link_1[0] * __v27 + __link_1[3] * __v28 + __link_1[6] * __v29
                - __v33;
            let __v35 = __v6 * __v32;
            let __v36 = __link_1[2] * __v27 + __link_1[5] * __v28 + __link_1[8] * __v29
                - __v35;
            let __v37 = __v1 * __v36 - __v5 * __v34;
            *__out_4 = __v37;
            let __v38 = __v4 * __v32;
            let __v39 = __link_1[1] * __v27 + __link_1[4] * __v28 + __link_1[7] * __v29
                - __v38;
            let __v40 = __v0 * __v39
                - __v3 * (__sin_cos_1[1] * __v34 - __sin_cos_1[0] * __v36);
            *__out_5 = __v40;
            let __v41 = __v20 * __v22;
            let __v42 = __v14 * __v18 - __v20 * __v41;
            *__out_6 = __v42;
            let __v43 = __sin_cos_0[1] * __v41 - __sin_cos_0[0] * __v18;
            let __v44 = __v9 * __v43;
            *__out_7 = __v44;
            let __v45 = __sin_cos_0[1] * __v18 + __sin_cos_0[0] * __v41;
            let __v46 = __sin_cos_0[3] * __v43;
            let __v47 = __sin_cos_0[2] * __v43;
            let __v48 = __v31 * __v41;
            let __v49 = __v2 * __v48;
            let __v50 = __link_1[0] * __v45 + __link_1[3] * __v46 - __link_1[6] * __v47
                - __v49;
            let __v51 = __link_1[2] * __v45 + __link_1[5] * __v46 - __link_1[8] * __v47;
            let __v52 = __v6 * __v48 - __v51;
            let __v53 = __v5 * __v50 + __v1 * __v52;
            *__out_8 = __v53;
            let __v54 = __link_1[1] * __v45 + __link_1[4] * __v46 - __link_1[7] * __v47;
            let __v55 = __v0 * (__v4 * __v48 - __v54);
            let __v56 = __v3 * (__sin_cos_1[1] * __v50 + __sin_cos_1[0] * __v52) + __v55;
            *__out_1 = -__v21;
            *__out_9 = __v56;
        }
        ///Aim of joint `eye`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `LeftHanded`.
        ///Aim of joint `head`, d aim / d pitch, d aim / d heading. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `LeftHanded`.
        fn aim_gradient(
            &self,
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[::core::primitive::f32; 12],
            __target: &[::core::primitive::f32; 3],
            __sin_cos: &[::core::primitive::f32; 4],
        ) -> [::core::primitive::f32; 3] {
            match __joint {
                0 => {
                    let __v0 = __target[1] * __sin_cos[3] - __target[2] * __sin_cos[2];
                    let __v1 = __target[0] * __sin_cos[1] - __sin_cos[0] * __v0;
                    let __v2 = __v1 - __effector_to_joint[9];
                    let __v3 = __sin_cos[1] * __v0 + __target[0] * __sin_cos[0];
                    let __v4 = __v3 - __effector_to_joint[10];
                    let __v5 = __target[1] * __sin_cos[2] + __target[2] * __sin_cos[3];
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
                    let __v16 = __v5 * (__sin_cos[1] * __v13 - __sin_cos[0] * __v14);
                    let __v17 = __v10
                        * (__v0 * (__effector_to_joint[5] - __v6 * __v12) - __v16);
                    [__v11, __v15, __v17]
                }
                1 => {
                    let __v0 = __target[0] * __sin_cos[3] + __target[1] * __sin_cos[2];
                    let __v1 = __sin_cos[1] * __v0 + __target[2] * __sin_cos[0];
                    let __v2 = __v1 - __effector_to_joint[9];
                    let __v3 = __target[1] * __sin_cos[3] - __target[0] * __sin_cos[2];
                    let __v4 = __v3 - __effector_to_joint[10];
                    let __v5 = __target[2] * __sin_cos[1] - __sin_cos[0] * __v0;
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
                    let __v13 = __effector_to_joint[3] - __v2 * __v12;
                    let __v14 = __effector_to_joint[5] - __v6 * __v12;
                    let __v15 = __v10 * (__v5 * __v13 - __v1 * __v14);
                    let __v16 = __v0 * (__effector_to_joint[4] - __v4 * __v12);
                    let __v17 = __v10
                        * (__v3 * (__sin_cos[1] * __v13 - __sin_cos[0] * __v14) - __v16);
                    [__v11, __v15, __v17]
                }
                _ => [0.0, 0.0, 0.0],
            }
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for LeftHanded {
        type Array<T: ::core::marker::Copy> = [T; 2];
        const RIG: &'static Self = &Self {
            eye: ::aim::__private::Joint::REST,
            head: ::aim::__private::Joint::REST,
        };
        const DESCRIPTION: &'static ::aim::__private::Description<'static> = &::aim::__private::Description::new(
                &[
                    ::aim::__private::JointInfo::new(
                            ::aim::__private::Axes {
                                up: [1.0, 0.0, 0.0],
                                forward: [0.0, 1.0, 0.0],
                                left: [0.0, 0.0, -1.0],
                            },
                            7.8539815,
                        )
                        .with_heading(-0.61086524, 0.61086524)
                        .with_pitch(-0.43633232, 0.34906584)
                        .with_stiffness(1.0)
                        .with_role(::aim::__private::Role::Eye),
                    ::aim::__private::JointInfo::new(
                            ::aim::__private::Axes {
                                up: [0.0, 0.0, -1.0],
                                forward: [-1.0, 0.0, 0.0],
                                left: [0.0, -1.0, 0.0],
                            },
                            2.9670596,
                        )
                        .with_heading(-1.0471976, 1.0471976)
                        .with_pitch(-0.6981317, 0.61086524)
                        .with_stiffness(1.0)
                        .with_role(::aim::__private::Role::Head),
                ],
            )
            .with_effector(::aim::__private::Effector {
                forward: [0.0, 1.0, 0.0],
                origin: [0.0, 0.0, 0.0],
            });
        #[inline]
        fn array<T: ::core::marker::Copy>(__value: T) -> [T; 2] {
            [__value; 2]
        }
        #[inline]
        fn from_joints([__joint_0, __joint_1]: [::aim::__private::Joint; 2]) -> Self {
            Self {
                eye: __joint_0,
                head: __joint_1,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<LeftHanded> for [::aim::__private::Joint; 2] {
        #[inline]
        fn from(__value: LeftHanded) -> Self {
            [__value.eye, __value.head]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<LeftHandedPose<T>> for [T; 2] {
        #[inline]
        fn from(__pose: LeftHandedPose<T>) -> Self {
            [__pose.eye, __pose.head]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<[T; 2]> for LeftHandedPose<T> {
        #[inline]
        fn from([__joint_0, __joint_1]: [T; 2]) -> Self {
            Self {
                eye: __joint_0,
                head: __joint_1,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<LeftHandedPose>
    for ::aim::__private::Pose<[::aim::__private::Affine3A; 2]> {
        #[inline]
        fn from(__pose: LeftHandedPose) -> Self {
            <Self>::new(::core::convert::Into::into(__pose))
        }
    }
};

// What the derive makes of a declaration in tests/src/declarations.rs; rewritten by
// AIM_BLESS=1 cargo test -p aim-tests --test it golden
///A value for each joint of [`Turret`]: its pose, corrections, or anything else that is wanted by name.
#[allow(dead_code, reason = "a rig may be used without it")]
#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
pub struct TurretPose<T = ::aim::__private::Affine3A> {
    ///Of the joint `barrel`.
    pub barrel: T,
    ///Of the joint `base`.
    pub base: T,
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
    impl ::aim::__private::Rig for Turret {
        #[inline]
        fn description(&self) -> ::aim::__private::Description<'_> {
            *<Self as ::aim::__private::AimRig>::DESCRIPTION
        }
        fn joint_name(
            &self,
            __joint: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match __joint {
                0 => ::core::option::Option::Some("barrel"),
                1 => ::core::option::Option::Some("base"),
                _ => ::core::option::Option::None,
            }
        }
        fn bone_name(
            &self,
            __joint: ::core::primitive::usize,
            __candidate: ::core::primitive::usize,
        ) -> ::core::option::Option<&::core::primitive::str> {
            match (__joint, __candidate) {
                (0, 0) => ::core::option::Option::Some("barrel"),
                (1, 0) => ::core::option::Option::Some("base"),
                _ => ::core::option::Option::None,
            }
        }
        ///The chain's stereographic residual (left, up), then the 2 derivatives of the first and of the second. 126 operations: 48 add, 75 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Turret`.
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
                ],
            ) = (__links, __sin_cos, &mut *__out) else {
                return <[::core::primitive::f32]>::fill(__out, 0.0);
            };
            let __v0 = __target[2] * __sin_cos_1[2] - __target[0] * __sin_cos_1[3];
            let __v1 = __v0 + __link_1[9];
            let __v2 = __link_1[10] - __target[1];
            let __v3 = __target[2] * __sin_cos_1[3] + __target[0] * __sin_cos_1[2];
            let __v4 = __link_1[11] - __v3;
            let __v5 = __link_1[0] * __v1 + __link_1[1] * __v2 + __link_1[2] * __v4
                + __link_0[9];
            let __v6 = __link_1[6] * __v1 + __link_1[7] * __v2 + __link_1[8] * __v4;
            let __v7 = __link_1[3] * __v1 + __link_1[4] * __v2 + __link_1[5] * __v4;
            let __v8 = __sin_cos_0[0] * __v6 + __sin_cos_0[1] * __v7;
            let __v9 = __v8 + __link_0[10];
            let __v10 = __sin_cos_0[1] * __v6 - __sin_cos_0[0] * __v7;
            let __v11 = __v10 + __link_0[11];
            let __v12 = __v11 * __v11 + __v5 * __v5 + __v9 * __v9;
            let __v13 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                __v12,
            );
            let __v14 = __link_0[6] * __v5 + __link_0[7] * __v9 + __link_0[8] * __v11
                + __v13;
            let __v15 = 1.0 / __v14;
            let __v16 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v14
            {
                __v15
            } else {
                0.0
            };
            let __v17 = 2.0 * __v16;
            let __v18 = __link_0[0] * __v5 + __link_0[1] * __v9 + __link_0[2] * __v11;
            let __v19 = __v17 * __v18;
            *__out_0 = __v19;
            let __v20 = __link_0[3] * __v5 + __link_0[4] * __v9 + __link_0[5] * __v11;
            let __v21 = __v17 * __v20;
            let __v22 = 1.0 / __v13;
            let __v23 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                < __v13
            {
                __v22
            } else {
                0.0
            };
            let __v24 = __v23 * (__v8 * __v11 - __v10 * __v9);
            let __v25 = __link_0[7] * __v10 - __link_0[8] * __v8 - __v24;
            let __v26 = __v16 * __v17;
            let __v27 = __v18 * __v26;
            let __v28 = __v17 * (__link_0[1] * __v10 - __link_0[2] * __v8)
                - __v25 * __v27;
            *__out_2 = __v28;
            let __v29 = __link_1[0] * __v3 + __link_1[2] * __v0;
            let __v30 = __link_1[6] * __v3 + __link_1[8] * __v0;
            let __v31 = __link_1[3] * __v3 + __link_1[5] * __v0;
            let __v32 = __sin_cos_0[0] * __v30 + __sin_cos_0[1] * __v31;
            let __v33 = __sin_cos_0[1] * __v30 - __sin_cos_0[0] * __v31;
            let __v34 = __v17
                * (__link_0[0] * __v29 + __link_0[1] * __v32 + __link_0[2] * __v33);
            let __v35 = __v23 * (__v11 * __v33 + __v5 * __v29 + __v9 * __v32);
            let __v36 = __link_0[6] * __v29 + __link_0[7] * __v32 + __link_0[8] * __v33
                + __v35;
            let __v37 = __v34 - __v36 * __v27;
            *__out_3 = __v37;
            let __v38 = __v20 * __v26;
            let __v39 = __v17 * (__link_0[5] * __v8 - __link_0[4] * __v10)
                + __v25 * __v38;
            *__out_4 = __v39;
            let __v40 = __v17
                * (__link_0[3] * __v29 + __link_0[4] * __v32 + __link_0[5] * __v33);
            let __v41 = __v36 * __v38 - __v40;
            *__out_1 = -__v21;
            *__out_5 = __v41;
        }
        ///Aim of joint `barrel`, d aim / d pitch, d aim / d heading. 31 operations: 12 add, 17 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
        ///Aim of joint `base`, d aim / d pitch, d aim / d heading. 31 operations: 12 add, 17 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
        fn aim_gradient(
            &self,
            __joint: ::core::primitive::usize,
            __effector_to_joint: &[::core::primitive::f32; 12],
            __target: &[::core::primitive::f32; 3],
            __sin_cos: &[::core::primitive::f32; 4],
        ) -> [::core::primitive::f32; 3] {
            match __joint {
                0 => {
                    let __v0 = __effector_to_joint[9] - __target[0];
                    let __v1 = __target[2] * __sin_cos[0] + __target[1] * __sin_cos[1];
                    let __v2 = __effector_to_joint[10] - __v1;
                    let __v3 = __target[2] * __sin_cos[1] - __target[1] * __sin_cos[0];
                    let __v4 = __effector_to_joint[11] - __v3;
                    let __v5 = __v0 * __v0 + __v2 * __v2 + __v4 * __v4;
                    let __v6 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                        __v5,
                    );
                    let __v7 = 1.0 / __v6;
                    let __v8 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                        < __v6
                    {
                        __v7
                    } else {
                        0.0
                    };
                    let __v9 = __v8
                        * (__effector_to_joint[6] * __v0 + __effector_to_joint[7] * __v2
                            + __effector_to_joint[8] * __v4);
                    let __v10 = __v8 * __v9;
                    let __v11 = __v3 * (__effector_to_joint[7] - __v2 * __v10);
                    let __v12 = __v8
                        * (__v1 * (__effector_to_joint[8] - __v4 * __v10) - __v11);
                    [__v9, __v12, 0.0]
                }
                1 => {
                    let __v0 = __target[2] * __sin_cos[2] - __target[0] * __sin_cos[3];
                    let __v1 = __v0 + __effector_to_joint[9];
                    let __v2 = __effector_to_joint[10] - __target[1];
                    let __v3 = __target[2] * __sin_cos[3] + __target[0] * __sin_cos[2];
                    let __v4 = __effector_to_joint[11] - __v3;
                    let __v5 = __v1 * __v1 + __v2 * __v2 + __v4 * __v4;
                    let __v6 = <::core::primitive::f32 as ::aim::__private::Scalar>::sqrt(
                        __v5,
                    );
                    let __v7 = 1.0 / __v6;
                    let __v8 = if <::core::primitive::f32 as ::aim::__private::Scalar>::TINY
                        < __v6
                    {
                        __v7
                    } else {
                        0.0
                    };
                    let __v9 = __v8
                        * (__effector_to_joint[6] * __v1 + __effector_to_joint[7] * __v2
                            + __effector_to_joint[8] * __v4);
                    let __v10 = __v8 * __v9;
                    let __v11 = __v3 * (__effector_to_joint[6] - __v1 * __v10);
                    let __v12 = __v8
                        * (__v0 * (__effector_to_joint[8] - __v4 * __v10) + __v11);
                    [__v9, 0.0, __v12]
                }
                _ => [0.0, 0.0, 0.0],
            }
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for Turret {
        type Array<T: ::core::marker::Copy> = [T; 2];
        const RIG: &'static Self = &Self {
            barrel: ::aim::__private::Joint::REST,
            base: ::aim::__private::Joint::REST,
        };
        const DESCRIPTION: &'static ::aim::__private::Description<'static> = &::aim::__private::Description::new(
                &[
                    ::aim::__private::JointInfo::new(
                            ::aim::__private::Axes {
                                up: [0.0, 1.0, 0.0],
                                forward: [0.0, 0.0, -1.0],
                                left: [-1.0, 0.0, 0.0],
                            },
                            1.5707964,
                        )
                        .with_pitch(-0.17453292, 1.3962634)
                        .with_stiffness(1.0),
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
                        .with_stiffness(1.0),
                ],
            )
            .with_effector(::aim::__private::Effector {
                forward: [0.0, 0.0, -1.0],
                origin: [0.0, 0.05, -0.8],
            });
        #[inline]
        fn array<T: ::core::marker::Copy>(__value: T) -> [T; 2] {
            [__value; 2]
        }
        #[inline]
        fn from_joints([__joint_0, __joint_1]: [::aim::__private::Joint; 2]) -> Self {
            Self {
                barrel: __joint_0,
                base: __joint_1,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<Turret> for [::aim::__private::Joint; 2] {
        #[inline]
        fn from(__value: Turret) -> Self {
            [__value.barrel, __value.base]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<TurretPose<T>> for [T; 2] {
        #[inline]
        fn from(__pose: TurretPose<T>) -> Self {
            [__pose.barrel, __pose.base]
        }
    }
    #[automatically_derived]
    impl<T> ::core::convert::From<[T; 2]> for TurretPose<T> {
        #[inline]
        fn from([__joint_0, __joint_1]: [T; 2]) -> Self {
            Self {
                barrel: __joint_0,
                base: __joint_1,
            }
        }
    }
    #[automatically_derived]
    impl ::core::convert::From<TurretPose>
    for ::aim::__private::Pose<[::aim::__private::Affine3A; 2]> {
        #[inline]
        fn from(__pose: TurretPose) -> Self {
            <Self>::new(::core::convert::Into::into(__pose))
        }
    }
};

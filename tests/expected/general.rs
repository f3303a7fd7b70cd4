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
        fn array<T: ::core::marker::Copy>(&self, __value: T) -> [T; 2] {
            [__value; 2]
        }
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
                    .with_comfort(0.5),
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
                    .with_absolute_range(),
            ];
            &INFOS
        }
        fn effector(&self) -> ::aim::__private::Effector {
            ::aim::__private::Effector {
                forward: [0.0, 0.0, 1.0],
                origin: [0.0, 0.0, 0.0],
            }
        }
        fn joints(&self) -> [::aim::__private::Joint; 2] {
            [self.left_eye, self.r#neck]
        }
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
        let __v0 = __target[2] * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v1 = __target[0] * <S as ::aim::__private::Scalar>::constant(0.6);
        let __v2 = __target[1] * <S as ::aim::__private::Scalar>::constant(0.224);
        let __v3 = __v1 - __v2;
        let __v4 = __v0 + __v3;
        let __v5 = __sin_cos[3] * __v4;
        let __v6 = __target[2]
            * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v7 = __target[0] * <S as ::aim::__private::Scalar>::constant(0.8);
        let __v8 = __target[1]
            * <S as ::aim::__private::Scalar>::constant(0.16800000000000004);
        let __v9 = __v7 + __v8;
        let __v10 = __v6 - __v9;
        let __v11 = __sin_cos[2] * __v10;
        let __v12 = __v11 - __v5;
        let __v13 = __sin_cos[0] * __v12;
        let __v14 = __target[2] * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v15 = __target[0]
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            );
        let __v16 = __target[1] * <S as ::aim::__private::Scalar>::constant(0.96);
        let __v17 = __v15 - __v16;
        let __v18 = __v17 - __v14;
        let __v19 = __sin_cos[1] * __v18;
        let __v20 = __v13 - __v19;
        let __v21 = __effector_to_joint[11]
            * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v22 = __effector_to_joint[9]
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            );
        let __v23 = __effector_to_joint[10]
            * <S as ::aim::__private::Scalar>::constant(0.96);
        let __v24 = __v22 - __v23;
        let __v25 = __v21 - __v24;
        let __v26 = __v25 - __v20;
        let __v27 = __v26 * __v26;
        let __v28 = __sin_cos[1] * __v12;
        let __v29 = __sin_cos[0] * __v18;
        let __v30 = __v28 + __v29;
        let __v31 = __effector_to_joint[11]
            * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v32 = __effector_to_joint[9]
            * <S as ::aim::__private::Scalar>::constant(0.6);
        let __v33 = __effector_to_joint[10]
            * <S as ::aim::__private::Scalar>::constant(0.224);
        let __v34 = __v32 - __v33;
        let __v35 = __v31 + __v34;
        let __v36 = __v30 + __v35;
        let __v37 = __v36 * __v36;
        let __v38 = __sin_cos[2] * __v4;
        let __v39 = __sin_cos[3] * __v10;
        let __v40 = __v38 + __v39;
        let __v41 = __effector_to_joint[11]
            * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v42 = __effector_to_joint[9]
            * <S as ::aim::__private::Scalar>::constant(0.8);
        let __v43 = __effector_to_joint[10]
            * <S as ::aim::__private::Scalar>::constant(0.16800000000000004);
        let __v44 = __v42 + __v43;
        let __v45 = __v41 - __v44;
        let __v46 = __v40 - __v45;
        let __v47 = __v46 * __v46;
        let __v48 = __v37 + __v47;
        let __v49 = __v27 + __v48;
        let __v50 = <S as ::aim::__private::Scalar>::sqrt(__v49);
        let __v51 = <S as ::aim::__private::Scalar>::constant(1.0) / __v50;
        let __v52 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v50,
            __v51,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v53 = __effector_to_joint[8]
            * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v54 = __effector_to_joint[6]
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            );
        let __v55 = __effector_to_joint[7]
            * <S as ::aim::__private::Scalar>::constant(0.96);
        let __v56 = __v54 - __v55;
        let __v57 = __v53 - __v56;
        let __v58 = __v26 * __v57;
        let __v59 = __effector_to_joint[8]
            * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v60 = __effector_to_joint[6]
            * <S as ::aim::__private::Scalar>::constant(0.6);
        let __v61 = __effector_to_joint[7]
            * <S as ::aim::__private::Scalar>::constant(0.224);
        let __v62 = __v60 - __v61;
        let __v63 = __v59 + __v62;
        let __v64 = __v36 * __v63;
        let __v65 = __effector_to_joint[8]
            * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v66 = __effector_to_joint[6]
            * <S as ::aim::__private::Scalar>::constant(0.8);
        let __v67 = __effector_to_joint[7]
            * <S as ::aim::__private::Scalar>::constant(0.16800000000000004);
        let __v68 = __v66 + __v67;
        let __v69 = __v65 - __v68;
        let __v70 = __v46 * __v69;
        let __v71 = __v70 - __v64;
        let __v72 = __v71 - __v58;
        let __v73 = __v52 * __v72;
        let __v74 = __v52 * __v73;
        let __v75 = __v36 * __v74;
        let __v76 = __v63 + __v75;
        let __v77 = __v20 * __v76;
        let __v78 = __v26 * __v74;
        let __v79 = __v57 + __v78;
        let __v80 = __v30 * __v79;
        let __v81 = __v77 + __v80;
        let __v82 = __v52 * __v81;
        let __v83 = __sin_cos[1] * __v76;
        let __v84 = __sin_cos[0] * __v79;
        let __v85 = __v84 - __v83;
        let __v86 = __v40 * __v85;
        let __v87 = __v46 * __v74;
        let __v88 = __v87 - __v69;
        let __v89 = __v12 * __v88;
        let __v90 = __v86 + __v89;
        let __v91 = __v52 * __v90;
        [__v73, __v82, __v91]
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `neck`. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `General`.
    #[inline]
    fn aim_gradient_1<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __target[0] * __sin_cos[3];
        let __v1 = __target[1] * __sin_cos[2];
        let __v2 = __v0 + __v1;
        let __v3 = __sin_cos[0] * __v2;
        let __v4 = __target[2] * __sin_cos[1];
        let __v5 = __v3 + __v4;
        let __v6 = __v5 - __effector_to_joint[11];
        let __v7 = __v6 * __v6;
        let __v8 = __sin_cos[1] * __v2;
        let __v9 = __target[2] * __sin_cos[0];
        let __v10 = __v8 - __v9;
        let __v11 = __v10 - __effector_to_joint[9];
        let __v12 = __v11 * __v11;
        let __v13 = __target[0] * __sin_cos[2];
        let __v14 = __target[1] * __sin_cos[3];
        let __v15 = __v14 - __v13;
        let __v16 = __v15 - __effector_to_joint[10];
        let __v17 = __v16 * __v16;
        let __v18 = __v12 + __v17;
        let __v19 = __v7 + __v18;
        let __v20 = <S as ::aim::__private::Scalar>::sqrt(__v19);
        let __v21 = <S as ::aim::__private::Scalar>::constant(1.0) / __v20;
        let __v22 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v20,
            __v21,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v23 = __effector_to_joint[8] * __v6;
        let __v24 = __effector_to_joint[6] * __v11;
        let __v25 = __effector_to_joint[7] * __v16;
        let __v26 = __v24 + __v25;
        let __v27 = __v23 + __v26;
        let __v28 = __v22 * __v27;
        let __v29 = __v22 * __v28;
        let __v30 = __v11 * __v29;
        let __v31 = __effector_to_joint[6] - __v30;
        let __v32 = __v5 * __v31;
        let __v33 = __v6 * __v29;
        let __v34 = __effector_to_joint[8] - __v33;
        let __v35 = __v10 * __v34;
        let __v36 = __v35 - __v32;
        let __v37 = __v22 * __v36;
        let __v38 = __sin_cos[1] * __v31;
        let __v39 = __sin_cos[0] * __v34;
        let __v40 = __v38 + __v39;
        let __v41 = __v15 * __v40;
        let __v42 = __v16 * __v29;
        let __v43 = __effector_to_joint[7] - __v42;
        let __v44 = __v2 * __v43;
        let __v45 = __v41 - __v44;
        let __v46 = __v22 * __v45;
        [__v28, __v37, __v46]
    }
    ///The chain's aim, then its derivatives. 170 operations: 66 add, 102 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `General`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 5] {
        let __v0 = __target[0] * __sin_cos[1][3];
        let __v1 = __target[1] * __sin_cos[1][2];
        let __v2 = __v0 + __v1;
        let __v3 = __sin_cos[1][0] * __v2;
        let __v4 = __target[2] * __sin_cos[1][1];
        let __v5 = __v3 + __v4;
        let __v6 = __links[1][11] - __v5;
        let __v7 = __links[1][8] * __v6;
        let __v8 = __sin_cos[1][1] * __v2;
        let __v9 = __target[2] * __sin_cos[1][0];
        let __v10 = __v8 - __v9;
        let __v11 = __links[1][9] - __v10;
        let __v12 = __links[1][6] * __v11;
        let __v13 = __target[0] * __sin_cos[1][2];
        let __v14 = __target[1] * __sin_cos[1][3];
        let __v15 = __v14 - __v13;
        let __v16 = __links[1][10] - __v15;
        let __v17 = __links[1][7] * __v16;
        let __v18 = __v12 + __v17;
        let __v19 = __v7 + __v18;
        let __v20 = __v19 * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v21 = __links[1][2] * __v6;
        let __v22 = __links[1][0] * __v11;
        let __v23 = __links[1][1] * __v16;
        let __v24 = __v22 + __v23;
        let __v25 = __v21 + __v24;
        let __v26 = __v25 * <S as ::aim::__private::Scalar>::constant(0.6);
        let __v27 = __links[1][5] * __v6;
        let __v28 = __links[1][3] * __v11;
        let __v29 = __links[1][4] * __v16;
        let __v30 = __v28 + __v29;
        let __v31 = __v27 + __v30;
        let __v32 = __v31 * <S as ::aim::__private::Scalar>::constant(0.224);
        let __v33 = __v26 - __v32;
        let __v34 = __v20 + __v33;
        let __v35 = __sin_cos[0][3] * __v34;
        let __v36 = __v19
            * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v37 = __v25 * <S as ::aim::__private::Scalar>::constant(0.8);
        let __v38 = __v31
            * <S as ::aim::__private::Scalar>::constant(0.16800000000000004);
        let __v39 = __v37 + __v38;
        let __v40 = __v36 - __v39;
        let __v41 = __sin_cos[0][2] * __v40;
        let __v42 = __v35 - __v41;
        let __v43 = __sin_cos[0][0] * __v42;
        let __v44 = __v19 * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v45 = __v25
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            );
        let __v46 = __v31 * <S as ::aim::__private::Scalar>::constant(0.96);
        let __v47 = __v45 - __v46;
        let __v48 = __v44 - __v47;
        let __v49 = __sin_cos[0][1] * __v48;
        let __v50 = __v43 - __v49;
        let __v51 = __links[0][11] * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v52 = __links[0][9]
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            );
        let __v53 = __links[0][10] * <S as ::aim::__private::Scalar>::constant(0.96);
        let __v54 = __v52 - __v53;
        let __v55 = __v51 - __v54;
        let __v56 = __v50 - __v55;
        let __v57 = __v56 * __v56;
        let __v58 = __sin_cos[0][1] * __v42;
        let __v59 = __sin_cos[0][0] * __v48;
        let __v60 = __v58 + __v59;
        let __v61 = __links[0][11] * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v62 = __links[0][9] * <S as ::aim::__private::Scalar>::constant(0.6);
        let __v63 = __links[0][10] * <S as ::aim::__private::Scalar>::constant(0.224);
        let __v64 = __v62 - __v63;
        let __v65 = __v61 + __v64;
        let __v66 = __v60 + __v65;
        let __v67 = __v66 * __v66;
        let __v68 = __sin_cos[0][2] * __v34;
        let __v69 = __sin_cos[0][3] * __v40;
        let __v70 = __v68 + __v69;
        let __v71 = __links[0][11]
            * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v72 = __links[0][9] * <S as ::aim::__private::Scalar>::constant(0.8);
        let __v73 = __links[0][10]
            * <S as ::aim::__private::Scalar>::constant(0.16800000000000004);
        let __v74 = __v72 + __v73;
        let __v75 = __v71 - __v74;
        let __v76 = __v70 + __v75;
        let __v77 = __v76 * __v76;
        let __v78 = __v67 + __v77;
        let __v79 = __v57 + __v78;
        let __v80 = <S as ::aim::__private::Scalar>::sqrt(__v79);
        let __v81 = <S as ::aim::__private::Scalar>::constant(1.0) / __v80;
        let __v82 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v80,
            __v81,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v83 = __links[0][8] * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v84 = __links[0][6]
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            );
        let __v85 = __links[0][7] * <S as ::aim::__private::Scalar>::constant(0.96);
        let __v86 = __v84 - __v85;
        let __v87 = __v83 - __v86;
        let __v88 = __v56 * __v87;
        let __v89 = __links[0][8] * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v90 = __links[0][6] * <S as ::aim::__private::Scalar>::constant(0.6);
        let __v91 = __links[0][7] * <S as ::aim::__private::Scalar>::constant(0.224);
        let __v92 = __v90 - __v91;
        let __v93 = __v89 + __v92;
        let __v94 = __v66 * __v93;
        let __v95 = __links[0][8]
            * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v96 = __links[0][6] * <S as ::aim::__private::Scalar>::constant(0.8);
        let __v97 = __links[0][7]
            * <S as ::aim::__private::Scalar>::constant(0.16800000000000004);
        let __v98 = __v96 + __v97;
        let __v99 = __v95 - __v98;
        let __v100 = __v76 * __v99;
        let __v101 = __v94 + __v100;
        let __v102 = __v88 - __v101;
        let __v103 = __v82 * __v102;
        let __v104 = __v82 * __v103;
        let __v105 = __v66 * __v104;
        let __v106 = __v93 + __v105;
        let __v107 = __v82 * __v106;
        let __v108 = __v50 * __v107;
        let __v109 = __v56 * __v104;
        let __v110 = __v87 - __v109;
        let __v111 = __v82 * __v110;
        let __v112 = __v60 * __v111;
        let __v113 = __v108 + __v112;
        let __v114 = __sin_cos[0][1] * __v107;
        let __v115 = __sin_cos[0][0] * __v111;
        let __v116 = __v114 - __v115;
        let __v117 = __v70 * __v116;
        let __v118 = __v76 * __v104;
        let __v119 = __v99 + __v118;
        let __v120 = __v82 * __v119;
        let __v121 = __v42 * __v120;
        let __v122 = __v117 - __v121;
        let __v123 = __sin_cos[0][0] * __v107;
        let __v124 = __sin_cos[0][1] * __v111;
        let __v125 = __v123 + __v124;
        let __v126 = <S as ::aim::__private::Scalar>::constant(0.28) * __v125;
        let __v127 = __sin_cos[0][3] * __v116;
        let __v128 = __sin_cos[0][2] * __v120;
        let __v129 = __v127 + __v128;
        let __v130 = <S as ::aim::__private::Scalar>::constant(0.768) * __v129;
        let __v131 = __sin_cos[0][2] * __v116;
        let __v132 = __sin_cos[0][3] * __v120;
        let __v133 = __v131 - __v132;
        let __v134 = <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
            * __v133;
        let __v135 = __v130 - __v134;
        let __v136 = __v126 + __v135;
        let __v137 = __links[1][6] * __v136;
        let __v138 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v125;
        let __v139 = <S as ::aim::__private::Scalar>::constant(0.6) * __v129;
        let __v140 = <S as ::aim::__private::Scalar>::constant(0.8) * __v133;
        let __v141 = __v139 + __v140;
        let __v142 = __v138 - __v141;
        let __v143 = __links[1][0] * __v142;
        let __v144 = <S as ::aim::__private::Scalar>::constant(0.96) * __v125;
        let __v145 = <S as ::aim::__private::Scalar>::constant(0.224) * __v129;
        let __v146 = <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
            * __v133;
        let __v147 = __v145 - __v146;
        let __v148 = __v144 - __v147;
        let __v149 = __links[1][3] * __v148;
        let __v150 = __v143 - __v149;
        let __v151 = __v137 - __v150;
        let __v152 = __v5 * __v151;
        let __v153 = __links[1][8] * __v136;
        let __v154 = __links[1][2] * __v142;
        let __v155 = __links[1][5] * __v148;
        let __v156 = __v154 - __v155;
        let __v157 = __v153 - __v156;
        let __v158 = __v10 * __v157;
        let __v159 = __v158 - __v152;
        let __v160 = __sin_cos[1][1] * __v151;
        let __v161 = __sin_cos[1][0] * __v157;
        let __v162 = __v160 + __v161;
        let __v163 = __v15 * __v162;
        let __v164 = __links[1][7] * __v136;
        let __v165 = __links[1][1] * __v142;
        let __v166 = __links[1][4] * __v148;
        let __v167 = __v165 - __v166;
        let __v168 = __v167 - __v164;
        let __v169 = __v2 * __v168;
        let __v170 = __v163 + __v169;
        [__v103, __v113, __v122, __v159, __v170]
    }
    ///The chain's residual (left, up), then the derivatives of each. 313 operations: 122 add, 188 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `General`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 10] {
        let __v0 = __target[0] * __sin_cos[1][3];
        let __v1 = __target[1] * __sin_cos[1][2];
        let __v2 = __v0 + __v1;
        let __v3 = __sin_cos[1][0] * __v2;
        let __v4 = __target[2] * __sin_cos[1][1];
        let __v5 = __v3 + __v4;
        let __v6 = __links[1][11] - __v5;
        let __v7 = __links[1][8] * __v6;
        let __v8 = __sin_cos[1][1] * __v2;
        let __v9 = __target[2] * __sin_cos[1][0];
        let __v10 = __v8 - __v9;
        let __v11 = __links[1][9] - __v10;
        let __v12 = __links[1][6] * __v11;
        let __v13 = __target[0] * __sin_cos[1][2];
        let __v14 = __target[1] * __sin_cos[1][3];
        let __v15 = __v14 - __v13;
        let __v16 = __links[1][10] - __v15;
        let __v17 = __links[1][7] * __v16;
        let __v18 = __v12 + __v17;
        let __v19 = __v7 + __v18;
        let __v20 = __v19 * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v21 = __links[1][2] * __v6;
        let __v22 = __links[1][0] * __v11;
        let __v23 = __links[1][1] * __v16;
        let __v24 = __v22 + __v23;
        let __v25 = __v21 + __v24;
        let __v26 = __v25 * <S as ::aim::__private::Scalar>::constant(0.6);
        let __v27 = __links[1][5] * __v6;
        let __v28 = __links[1][3] * __v11;
        let __v29 = __links[1][4] * __v16;
        let __v30 = __v28 + __v29;
        let __v31 = __v27 + __v30;
        let __v32 = __v31 * <S as ::aim::__private::Scalar>::constant(0.224);
        let __v33 = __v26 - __v32;
        let __v34 = __v20 + __v33;
        let __v35 = __sin_cos[0][3] * __v34;
        let __v36 = __v19
            * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v37 = __v25 * <S as ::aim::__private::Scalar>::constant(0.8);
        let __v38 = __v31
            * <S as ::aim::__private::Scalar>::constant(0.16800000000000004);
        let __v39 = __v37 + __v38;
        let __v40 = __v36 - __v39;
        let __v41 = __sin_cos[0][2] * __v40;
        let __v42 = __v35 - __v41;
        let __v43 = __sin_cos[0][0] * __v42;
        let __v44 = __v19 * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v45 = __v25
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            );
        let __v46 = __v31 * <S as ::aim::__private::Scalar>::constant(0.96);
        let __v47 = __v45 - __v46;
        let __v48 = __v44 - __v47;
        let __v49 = __sin_cos[0][1] * __v48;
        let __v50 = __v43 - __v49;
        let __v51 = __links[0][11] * <S as ::aim::__private::Scalar>::constant(0.28);
        let __v52 = __links[0][9]
            * <S as ::aim::__private::Scalar>::constant(
                0.000000000000000016653345369377347,
            );
        let __v53 = __links[0][10] * <S as ::aim::__private::Scalar>::constant(0.96);
        let __v54 = __v52 - __v53;
        let __v55 = __v51 - __v54;
        let __v56 = __v50 - __v55;
        let __v57 = __v56 * __v56;
        let __v58 = __sin_cos[0][1] * __v42;
        let __v59 = __sin_cos[0][0] * __v48;
        let __v60 = __v58 + __v59;
        let __v61 = __links[0][11] * <S as ::aim::__private::Scalar>::constant(0.768);
        let __v62 = __links[0][9] * <S as ::aim::__private::Scalar>::constant(0.6);
        let __v63 = __links[0][10] * <S as ::aim::__private::Scalar>::constant(0.224);
        let __v64 = __v62 - __v63;
        let __v65 = __v61 + __v64;
        let __v66 = __v60 + __v65;
        let __v67 = __v66 * __v66;
        let __v68 = __sin_cos[0][2] * __v34;
        let __v69 = __sin_cos[0][3] * __v40;
        let __v70 = __v68 + __v69;
        let __v71 = __links[0][11]
            * <S as ::aim::__private::Scalar>::constant(0.5760000000000001);
        let __v72 = __links[0][9] * <S as ::aim::__private::Scalar>::constant(0.8);
        let __v73 = __links[0][10]
            * <S as ::aim::__private::Scalar>::constant(0.16800000000000004);
        let __v74 = __v72 + __v73;
        let __v75 = __v71 - __v74;
        let __v76 = __v70 + __v75;
        let __v77 = __v76 * __v76;
        let __v78 = __v67 + __v77;
        let __v79 = __v57 + __v78;
        let __v80 = <S as ::aim::__private::Scalar>::sqrt(__v79);
        let __v81 = <S as ::aim::__private::Scalar>::constant(0.28) * __v50;
        let __v82 = <S as ::aim::__private::Scalar>::constant(0.768) * __v60;
        let __v83 = <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
            * __v70;
        let __v84 = __v82 + __v83;
        let __v85 = __v81 - __v84;
        let __v86 = __links[0][11] - __v85;
        let __v87 = __links[0][8] * __v86;
        let __v88 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v50;
        let __v89 = <S as ::aim::__private::Scalar>::constant(0.6) * __v60;
        let __v90 = <S as ::aim::__private::Scalar>::constant(0.8) * __v70;
        let __v91 = __v89 - __v90;
        let __v92 = __v88 + __v91;
        let __v93 = __links[0][9] + __v92;
        let __v94 = __links[0][6] * __v93;
        let __v95 = <S as ::aim::__private::Scalar>::constant(0.96) * __v50;
        let __v96 = <S as ::aim::__private::Scalar>::constant(0.224) * __v60;
        let __v97 = <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
            * __v70;
        let __v98 = __v96 + __v97;
        let __v99 = __v95 + __v98;
        let __v100 = __links[0][10] - __v99;
        let __v101 = __links[0][7] * __v100;
        let __v102 = __v94 + __v101;
        let __v103 = __v87 + __v102;
        let __v104 = __v80 - __v103;
        let __v105 = <S as ::aim::__private::Scalar>::constant(1.0) / __v104;
        let __v106 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v104,
            __v105,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v107 = <S as ::aim::__private::Scalar>::constant(2.0) * __v106;
        let __v108 = __links[0][5]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            );
        let __v109 = __links[0][2] + __v108;
        let __v110 = __v86 * __v109;
        let __v111 = __links[0][3]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            );
        let __v112 = __links[0][0] + __v111;
        let __v113 = __v93 * __v112;
        let __v114 = __links[0][4]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            );
        let __v115 = __links[0][1] + __v114;
        let __v116 = __v100 * __v115;
        let __v117 = __v113 + __v116;
        let __v118 = __v110 + __v117;
        let __v119 = __v107 * __v118;
        let __v120 = __links[0][2]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            );
        let __v121 = __v120 - __links[0][5];
        let __v122 = __v86 * __v121;
        let __v123 = __links[0][0]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            );
        let __v124 = __v123 - __links[0][3];
        let __v125 = __v93 * __v124;
        let __v126 = __links[0][1]
            * <S as ::aim::__private::Scalar>::constant(
                0.00000000000000001734723475976807,
            );
        let __v127 = __v126 - __links[0][4];
        let __v128 = __v100 * __v127;
        let __v129 = __v125 + __v128;
        let __v130 = __v122 + __v129;
        let __v131 = __v107 * __v130;
        let __v132 = __v107 * __v109;
        let __v133 = <S as ::aim::__private::Scalar>::constant(2.0) * __v118;
        let __v134 = __v106 * __v106;
        let __v135 = __v133 * __v134;
        let __v136 = __links[0][8] * __v135;
        let __v137 = __v132 + __v136;
        let __v138 = <S as ::aim::__private::Scalar>::constant(0.768) * __v137;
        let __v139 = __v107 * __v112;
        let __v140 = __links[0][6] * __v135;
        let __v141 = __v139 + __v140;
        let __v142 = <S as ::aim::__private::Scalar>::constant(0.6) * __v141;
        let __v143 = __v107 * __v115;
        let __v144 = __links[0][7] * __v135;
        let __v145 = __v143 + __v144;
        let __v146 = <S as ::aim::__private::Scalar>::constant(0.224) * __v145;
        let __v147 = __v142 - __v146;
        let __v148 = __v138 + __v147;
        let __v149 = <S as ::aim::__private::Scalar>::constant(1.0) / __v80;
        let __v150 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v80,
            __v149,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v151 = __v135 * __v150;
        let __v152 = __v66 * __v151;
        let __v153 = __v148 - __v152;
        let __v154 = __v50 * __v153;
        let __v155 = <S as ::aim::__private::Scalar>::constant(0.28) * __v137;
        let __v156 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v141;
        let __v157 = <S as ::aim::__private::Scalar>::constant(0.96) * __v145;
        let __v158 = __v156 - __v157;
        let __v159 = __v155 - __v158;
        let __v160 = __v56 * __v151;
        let __v161 = __v159 + __v160;
        let __v162 = __v60 * __v161;
        let __v163 = __v154 + __v162;
        let __v164 = __sin_cos[0][1] * __v153;
        let __v165 = __sin_cos[0][0] * __v161;
        let __v166 = __v164 - __v165;
        let __v167 = __v70 * __v166;
        let __v168 = <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
            * __v137;
        let __v169 = <S as ::aim::__private::Scalar>::constant(0.8) * __v141;
        let __v170 = <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
            * __v145;
        let __v171 = __v169 + __v170;
        let __v172 = __v168 - __v171;
        let __v173 = __v76 * __v151;
        let __v174 = __v172 - __v173;
        let __v175 = __v42 * __v174;
        let __v176 = __v167 - __v175;
        let __v177 = __sin_cos[0][0] * __v153;
        let __v178 = __sin_cos[0][1] * __v161;
        let __v179 = __v177 + __v178;
        let __v180 = <S as ::aim::__private::Scalar>::constant(0.28) * __v179;
        let __v181 = __sin_cos[0][3] * __v166;
        let __v182 = __sin_cos[0][2] * __v174;
        let __v183 = __v181 + __v182;
        let __v184 = <S as ::aim::__private::Scalar>::constant(0.768) * __v183;
        let __v185 = __sin_cos[0][2] * __v166;
        let __v186 = __sin_cos[0][3] * __v174;
        let __v187 = __v185 - __v186;
        let __v188 = <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
            * __v187;
        let __v189 = __v184 - __v188;
        let __v190 = __v180 + __v189;
        let __v191 = __links[1][6] * __v190;
        let __v192 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v179;
        let __v193 = <S as ::aim::__private::Scalar>::constant(0.6) * __v183;
        let __v194 = <S as ::aim::__private::Scalar>::constant(0.8) * __v187;
        let __v195 = __v193 + __v194;
        let __v196 = __v192 - __v195;
        let __v197 = __links[1][0] * __v196;
        let __v198 = <S as ::aim::__private::Scalar>::constant(0.96) * __v179;
        let __v199 = <S as ::aim::__private::Scalar>::constant(0.224) * __v183;
        let __v200 = <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
            * __v187;
        let __v201 = __v199 - __v200;
        let __v202 = __v198 - __v201;
        let __v203 = __links[1][3] * __v202;
        let __v204 = __v197 - __v203;
        let __v205 = __v191 - __v204;
        let __v206 = __v5 * __v205;
        let __v207 = __links[1][8] * __v190;
        let __v208 = __links[1][2] * __v196;
        let __v209 = __links[1][5] * __v202;
        let __v210 = __v208 - __v209;
        let __v211 = __v207 - __v210;
        let __v212 = __v10 * __v211;
        let __v213 = __v212 - __v206;
        let __v214 = __sin_cos[1][1] * __v205;
        let __v215 = __sin_cos[1][0] * __v211;
        let __v216 = __v214 + __v215;
        let __v217 = __v15 * __v216;
        let __v218 = __links[1][7] * __v190;
        let __v219 = __links[1][1] * __v196;
        let __v220 = __links[1][4] * __v202;
        let __v221 = __v219 - __v220;
        let __v222 = __v221 - __v218;
        let __v223 = __v2 * __v222;
        let __v224 = __v217 + __v223;
        let __v225 = __v107 * __v121;
        let __v226 = <S as ::aim::__private::Scalar>::constant(2.0) * __v130;
        let __v227 = __v134 * __v226;
        let __v228 = __links[0][8] * __v227;
        let __v229 = __v225 + __v228;
        let __v230 = <S as ::aim::__private::Scalar>::constant(0.768) * __v229;
        let __v231 = __v107 * __v124;
        let __v232 = __links[0][6] * __v227;
        let __v233 = __v231 + __v232;
        let __v234 = <S as ::aim::__private::Scalar>::constant(0.6) * __v233;
        let __v235 = __v107 * __v127;
        let __v236 = __links[0][7] * __v227;
        let __v237 = __v235 + __v236;
        let __v238 = <S as ::aim::__private::Scalar>::constant(0.224) * __v237;
        let __v239 = __v238 - __v234;
        let __v240 = __v239 - __v230;
        let __v241 = __v150 * __v227;
        let __v242 = __v66 * __v241;
        let __v243 = __v240 + __v242;
        let __v244 = __v50 * __v243;
        let __v245 = <S as ::aim::__private::Scalar>::constant(0.28) * __v229;
        let __v246 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v233;
        let __v247 = <S as ::aim::__private::Scalar>::constant(0.96) * __v237;
        let __v248 = __v247 - __v246;
        let __v249 = __v245 + __v248;
        let __v250 = __v56 * __v241;
        let __v251 = __v249 + __v250;
        let __v252 = __v60 * __v251;
        let __v253 = __v244 - __v252;
        let __v254 = __sin_cos[0][1] * __v243;
        let __v255 = __sin_cos[0][0] * __v251;
        let __v256 = __v254 + __v255;
        let __v257 = __v70 * __v256;
        let __v258 = <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
            * __v229;
        let __v259 = <S as ::aim::__private::Scalar>::constant(0.8) * __v233;
        let __v260 = <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
            * __v237;
        let __v261 = __v259 + __v260;
        let __v262 = __v261 - __v258;
        let __v263 = __v76 * __v241;
        let __v264 = __v262 + __v263;
        let __v265 = __v42 * __v264;
        let __v266 = __v257 - __v265;
        let __v267 = __sin_cos[0][0] * __v243;
        let __v268 = __sin_cos[0][1] * __v251;
        let __v269 = __v267 - __v268;
        let __v270 = <S as ::aim::__private::Scalar>::constant(0.28) * __v269;
        let __v271 = __sin_cos[0][3] * __v256;
        let __v272 = __sin_cos[0][2] * __v264;
        let __v273 = __v271 + __v272;
        let __v274 = <S as ::aim::__private::Scalar>::constant(0.768) * __v273;
        let __v275 = __sin_cos[0][2] * __v256;
        let __v276 = __sin_cos[0][3] * __v264;
        let __v277 = __v275 - __v276;
        let __v278 = <S as ::aim::__private::Scalar>::constant(0.5760000000000001)
            * __v277;
        let __v279 = __v274 - __v278;
        let __v280 = __v270 + __v279;
        let __v281 = __links[1][6] * __v280;
        let __v282 = <S as ::aim::__private::Scalar>::constant(
            0.000000000000000016653345369377347,
        ) * __v269;
        let __v283 = <S as ::aim::__private::Scalar>::constant(0.6) * __v273;
        let __v284 = <S as ::aim::__private::Scalar>::constant(0.8) * __v277;
        let __v285 = __v283 + __v284;
        let __v286 = __v282 - __v285;
        let __v287 = __links[1][0] * __v286;
        let __v288 = <S as ::aim::__private::Scalar>::constant(0.96) * __v269;
        let __v289 = <S as ::aim::__private::Scalar>::constant(0.224) * __v273;
        let __v290 = <S as ::aim::__private::Scalar>::constant(0.16800000000000004)
            * __v277;
        let __v291 = __v289 - __v290;
        let __v292 = __v288 - __v291;
        let __v293 = __links[1][3] * __v292;
        let __v294 = __v287 - __v293;
        let __v295 = __v281 - __v294;
        let __v296 = __v5 * __v295;
        let __v297 = __links[1][8] * __v280;
        let __v298 = __links[1][2] * __v286;
        let __v299 = __links[1][5] * __v292;
        let __v300 = __v298 - __v299;
        let __v301 = __v297 - __v300;
        let __v302 = __v10 * __v301;
        let __v303 = __v302 - __v296;
        let __v304 = __sin_cos[1][1] * __v295;
        let __v305 = __sin_cos[1][0] * __v301;
        let __v306 = __v304 + __v305;
        let __v307 = __v15 * __v306;
        let __v308 = __links[1][7] * __v280;
        let __v309 = __links[1][1] * __v286;
        let __v310 = __links[1][4] * __v292;
        let __v311 = __v309 - __v310;
        let __v312 = __v308 - __v311;
        let __v313 = __v2 * __v312;
        let __v314 = __v307 - __v313;
        [-__v119, __v131, __v163, __v176, __v213, __v224, __v253, __v266, __v303, __v314]
    }
};

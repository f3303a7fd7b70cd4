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
    impl LeftHanded {
        /// The names that each joint's bone may have in a model, from the effector inward.
        #[allow(
            dead_code,
            unreachable_pub,
            reason = "a rig need not be looked up by its bones' names"
        )]
        pub const BONES: [&'static [&'static ::core::primitive::str]; 2] = [
            &["eye"],
            &["head"],
        ];
    }
    #[automatically_derived]
    impl ::core::default::Default for LeftHanded {
        /// At rest: every angle 0.
        fn default() -> Self {
            Self {
                eye: ::core::default::Default::default(),
                head: ::core::default::Default::default(),
            }
        }
    }
    #[automatically_derived]
    impl ::core::fmt::Debug for LeftHanded {
        fn fmt(
            &self,
            __formatter: &mut ::core::fmt::Formatter<'_>,
        ) -> ::core::fmt::Result {
            ::core::fmt::DebugStruct::finish(
                ::core::fmt::DebugStruct::field(
                    ::core::fmt::DebugStruct::field(
                        &mut ::core::fmt::Formatter::debug_struct(
                            __formatter,
                            "LeftHanded",
                        ),
                        "eye",
                        &self.eye,
                    ),
                    "head",
                    &self.head,
                ),
            )
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for LeftHanded {
        type Array<T: ::core::marker::Copy> = [T; 2];
        fn array<T: ::core::marker::Copy>(&self, __value: T) -> [T; 2] {
            [__value; 2]
        }
        fn joint_infos(&self) -> &[::aim::__private::JointInfo] {
            const INFOS: [::aim::__private::JointInfo; 2] = [
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
                    .with_comfort(1.0),
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
                    .with_comfort(1.0),
            ];
            &INFOS
        }
        fn effector(&self) -> ::aim::__private::Effector {
            ::aim::__private::Effector {
                forward: [0.0, 1.0, 0.0],
                origin: [0.0, 0.0, 0.0],
            }
        }
        fn joints(&self) -> [::aim::__private::Joint; 2] {
            [self.eye, self.head]
        }
        fn set_joints(&mut self, __states: [::aim::__private::Joint; 2]) {
            [self.eye, self.head] = __states;
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
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `eye`. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `LeftHanded`.
    #[inline]
    fn aim_gradient_0<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __target[1] * __sin_cos[3];
        let __v1 = __target[2] * __sin_cos[2];
        let __v2 = __v0 - __v1;
        let __v3 = __sin_cos[0] * __v2;
        let __v4 = __target[0] * __sin_cos[1];
        let __v5 = __v4 - __v3;
        let __v6 = __v5 - __effector_to_joint[9];
        let __v7 = __v6 * __v6;
        let __v8 = __sin_cos[1] * __v2;
        let __v9 = __target[0] * __sin_cos[0];
        let __v10 = __v8 + __v9;
        let __v11 = __v10 - __effector_to_joint[10];
        let __v12 = __v11 * __v11;
        let __v13 = __target[1] * __sin_cos[2];
        let __v14 = __target[2] * __sin_cos[3];
        let __v15 = __v13 + __v14;
        let __v16 = __v15 - __effector_to_joint[11];
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
        let __v23 = __effector_to_joint[3] * __v6;
        let __v24 = __effector_to_joint[4] * __v11;
        let __v25 = __effector_to_joint[5] * __v16;
        let __v26 = __v24 + __v25;
        let __v27 = __v23 + __v26;
        let __v28 = __v22 * __v27;
        let __v29 = __v22 * __v28;
        let __v30 = __v11 * __v29;
        let __v31 = __effector_to_joint[4] - __v30;
        let __v32 = __v5 * __v31;
        let __v33 = __v6 * __v29;
        let __v34 = __effector_to_joint[3] - __v33;
        let __v35 = __v10 * __v34;
        let __v36 = __v32 - __v35;
        let __v37 = __v22 * __v36;
        let __v38 = __sin_cos[1] * __v31;
        let __v39 = __sin_cos[0] * __v34;
        let __v40 = __v38 - __v39;
        let __v41 = __v15 * __v40;
        let __v42 = __v16 * __v29;
        let __v43 = __effector_to_joint[5] - __v42;
        let __v44 = __v2 * __v43;
        let __v45 = __v44 - __v41;
        let __v46 = __v22 * __v45;
        [__v28, __v37, __v46]
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `head`. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `LeftHanded`.
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
        let __v5 = __v4 - __v3;
        let __v6 = __v5 - __effector_to_joint[11];
        let __v7 = __v6 * __v6;
        let __v8 = __sin_cos[1] * __v2;
        let __v9 = __target[2] * __sin_cos[0];
        let __v10 = __v8 + __v9;
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
        let __v23 = __effector_to_joint[5] * __v6;
        let __v24 = __effector_to_joint[3] * __v11;
        let __v25 = __effector_to_joint[4] * __v16;
        let __v26 = __v24 + __v25;
        let __v27 = __v23 + __v26;
        let __v28 = __v22 * __v27;
        let __v29 = __v22 * __v28;
        let __v30 = __v11 * __v29;
        let __v31 = __effector_to_joint[3] - __v30;
        let __v32 = __v5 * __v31;
        let __v33 = __v6 * __v29;
        let __v34 = __effector_to_joint[5] - __v33;
        let __v35 = __v10 * __v34;
        let __v36 = __v32 - __v35;
        let __v37 = __v22 * __v36;
        let __v38 = __sin_cos[1] * __v31;
        let __v39 = __sin_cos[0] * __v34;
        let __v40 = __v38 - __v39;
        let __v41 = __v15 * __v40;
        let __v42 = __v16 * __v29;
        let __v43 = __effector_to_joint[4] - __v42;
        let __v44 = __v2 * __v43;
        let __v45 = __v41 - __v44;
        let __v46 = __v22 * __v45;
        [__v28, __v37, __v46]
    }
    ///The chain's aim, then its derivatives. 110 operations: 42 add, 66 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `LeftHanded`.
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
        let __v5 = __v4 - __v3;
        let __v6 = __v5 - __links[1][11];
        let __v7 = __links[1][5] * __v6;
        let __v8 = __sin_cos[1][1] * __v2;
        let __v9 = __target[2] * __sin_cos[1][0];
        let __v10 = __v8 + __v9;
        let __v11 = __v10 - __links[1][9];
        let __v12 = __links[1][3] * __v11;
        let __v13 = __target[0] * __sin_cos[1][2];
        let __v14 = __target[1] * __sin_cos[1][3];
        let __v15 = __v14 - __v13;
        let __v16 = __v15 - __links[1][10];
        let __v17 = __links[1][4] * __v16;
        let __v18 = __v12 + __v17;
        let __v19 = __v7 + __v18;
        let __v20 = __sin_cos[0][3] * __v19;
        let __v21 = __links[1][8] * __v6;
        let __v22 = __links[1][6] * __v11;
        let __v23 = __links[1][7] * __v16;
        let __v24 = __v22 + __v23;
        let __v25 = __v21 + __v24;
        let __v26 = __sin_cos[0][2] * __v25;
        let __v27 = __v20 - __v26;
        let __v28 = __sin_cos[0][0] * __v27;
        let __v29 = __links[1][2] * __v6;
        let __v30 = __links[1][0] * __v11;
        let __v31 = __links[1][1] * __v16;
        let __v32 = __v30 + __v31;
        let __v33 = __v29 + __v32;
        let __v34 = __sin_cos[0][1] * __v33;
        let __v35 = __v34 - __v28;
        let __v36 = __v35 - __links[0][9];
        let __v37 = __v36 * __v36;
        let __v38 = __sin_cos[0][1] * __v27;
        let __v39 = __sin_cos[0][0] * __v33;
        let __v40 = __v38 + __v39;
        let __v41 = __v40 - __links[0][10];
        let __v42 = __v41 * __v41;
        let __v43 = __sin_cos[0][2] * __v19;
        let __v44 = __sin_cos[0][3] * __v25;
        let __v45 = __v43 + __v44;
        let __v46 = __v45 - __links[0][11];
        let __v47 = __v46 * __v46;
        let __v48 = __v42 + __v47;
        let __v49 = __v37 + __v48;
        let __v50 = <S as ::aim::__private::Scalar>::sqrt(__v49);
        let __v51 = <S as ::aim::__private::Scalar>::constant(1.0) / __v50;
        let __v52 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v50,
            __v51,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v53 = __links[0][3] * __v36;
        let __v54 = __links[0][4] * __v41;
        let __v55 = __links[0][5] * __v46;
        let __v56 = __v54 + __v55;
        let __v57 = __v53 + __v56;
        let __v58 = __v52 * __v57;
        let __v59 = __v52 * __v58;
        let __v60 = __v41 * __v59;
        let __v61 = __links[0][4] - __v60;
        let __v62 = __v52 * __v61;
        let __v63 = __v35 * __v62;
        let __v64 = __v36 * __v59;
        let __v65 = __links[0][3] - __v64;
        let __v66 = __v52 * __v65;
        let __v67 = __v40 * __v66;
        let __v68 = __v63 - __v67;
        let __v69 = __sin_cos[0][1] * __v62;
        let __v70 = __sin_cos[0][0] * __v66;
        let __v71 = __v69 - __v70;
        let __v72 = __v45 * __v71;
        let __v73 = __v46 * __v59;
        let __v74 = __links[0][5] - __v73;
        let __v75 = __v52 * __v74;
        let __v76 = __v27 * __v75;
        let __v77 = __v76 - __v72;
        let __v78 = __sin_cos[0][2] * __v71;
        let __v79 = __sin_cos[0][3] * __v75;
        let __v80 = __v78 - __v79;
        let __v81 = __links[1][6] * __v80;
        let __v82 = __sin_cos[0][0] * __v62;
        let __v83 = __sin_cos[0][1] * __v66;
        let __v84 = __v82 + __v83;
        let __v85 = __links[1][0] * __v84;
        let __v86 = __sin_cos[0][3] * __v71;
        let __v87 = __sin_cos[0][2] * __v75;
        let __v88 = __v86 + __v87;
        let __v89 = __links[1][3] * __v88;
        let __v90 = __v85 + __v89;
        let __v91 = __v81 - __v90;
        let __v92 = __v5 * __v91;
        let __v93 = __links[1][8] * __v80;
        let __v94 = __links[1][2] * __v84;
        let __v95 = __links[1][5] * __v88;
        let __v96 = __v94 + __v95;
        let __v97 = __v93 - __v96;
        let __v98 = __v10 * __v97;
        let __v99 = __v98 - __v92;
        let __v100 = __sin_cos[1][1] * __v91;
        let __v101 = __sin_cos[1][0] * __v97;
        let __v102 = __v100 - __v101;
        let __v103 = __v15 * __v102;
        let __v104 = __links[1][7] * __v80;
        let __v105 = __links[1][1] * __v84;
        let __v106 = __links[1][4] * __v88;
        let __v107 = __v105 + __v106;
        let __v108 = __v104 - __v107;
        let __v109 = __v2 * __v108;
        let __v110 = __v109 - __v103;
        [__v58, __v68, __v77, __v99, __v110]
    }
    ///The chain's residual (left, up), then the derivatives of each. 193 operations: 71 add, 119 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `LeftHanded`.
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
        let __v5 = __v4 - __v3;
        let __v6 = __links[1][11] - __v5;
        let __v7 = __links[1][5] * __v6;
        let __v8 = __sin_cos[1][1] * __v2;
        let __v9 = __target[2] * __sin_cos[1][0];
        let __v10 = __v8 + __v9;
        let __v11 = __links[1][9] - __v10;
        let __v12 = __links[1][3] * __v11;
        let __v13 = __target[0] * __sin_cos[1][2];
        let __v14 = __target[1] * __sin_cos[1][3];
        let __v15 = __v14 - __v13;
        let __v16 = __links[1][10] - __v15;
        let __v17 = __links[1][4] * __v16;
        let __v18 = __v12 + __v17;
        let __v19 = __v7 + __v18;
        let __v20 = __sin_cos[0][3] * __v19;
        let __v21 = __links[1][8] * __v6;
        let __v22 = __links[1][6] * __v11;
        let __v23 = __links[1][7] * __v16;
        let __v24 = __v22 + __v23;
        let __v25 = __v21 + __v24;
        let __v26 = __sin_cos[0][2] * __v25;
        let __v27 = __v20 - __v26;
        let __v28 = __sin_cos[0][0] * __v27;
        let __v29 = __links[1][2] * __v6;
        let __v30 = __links[1][0] * __v11;
        let __v31 = __links[1][1] * __v16;
        let __v32 = __v30 + __v31;
        let __v33 = __v29 + __v32;
        let __v34 = __sin_cos[0][1] * __v33;
        let __v35 = __v28 - __v34;
        let __v36 = __links[0][9] - __v35;
        let __v37 = __v36 * __v36;
        let __v38 = __sin_cos[0][1] * __v27;
        let __v39 = __sin_cos[0][0] * __v33;
        let __v40 = __v38 + __v39;
        let __v41 = __links[0][10] + __v40;
        let __v42 = __v41 * __v41;
        let __v43 = __sin_cos[0][2] * __v19;
        let __v44 = __sin_cos[0][3] * __v25;
        let __v45 = __v43 + __v44;
        let __v46 = __links[0][11] + __v45;
        let __v47 = __v46 * __v46;
        let __v48 = __v42 + __v47;
        let __v49 = __v37 + __v48;
        let __v50 = <S as ::aim::__private::Scalar>::sqrt(__v49);
        let __v51 = __links[0][5] * __v46;
        let __v52 = __links[0][3] * __v36;
        let __v53 = __links[0][4] * __v41;
        let __v54 = __v52 + __v53;
        let __v55 = __v51 + __v54;
        let __v56 = __v50 - __v55;
        let __v57 = <S as ::aim::__private::Scalar>::constant(1.0) / __v56;
        let __v58 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v56,
            __v57,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v59 = <S as ::aim::__private::Scalar>::constant(2.0) * __v58;
        let __v60 = __links[0][8] * __v46;
        let __v61 = __links[0][6] * __v36;
        let __v62 = __links[0][7] * __v41;
        let __v63 = __v61 + __v62;
        let __v64 = __v60 + __v63;
        let __v65 = __v59 * __v64;
        let __v66 = __links[0][2] * __v46;
        let __v67 = __links[0][0] * __v36;
        let __v68 = __links[0][1] * __v41;
        let __v69 = __v67 + __v68;
        let __v70 = __v66 + __v69;
        let __v71 = __v59 * __v70;
        let __v72 = __links[0][7] * __v59;
        let __v73 = <S as ::aim::__private::Scalar>::constant(2.0) * __v64;
        let __v74 = __v58 * __v58;
        let __v75 = __v73 * __v74;
        let __v76 = __links[0][4] * __v75;
        let __v77 = __v72 + __v76;
        let __v78 = <S as ::aim::__private::Scalar>::constant(1.0) / __v50;
        let __v79 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v50,
            __v78,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v80 = __v75 * __v79;
        let __v81 = __v41 * __v80;
        let __v82 = __v81 - __v77;
        let __v83 = __v35 * __v82;
        let __v84 = __links[0][6] * __v59;
        let __v85 = __links[0][3] * __v75;
        let __v86 = __v84 + __v85;
        let __v87 = __v36 * __v80;
        let __v88 = __v87 - __v86;
        let __v89 = __v40 * __v88;
        let __v90 = __v83 + __v89;
        let __v91 = __sin_cos[0][1] * __v82;
        let __v92 = __sin_cos[0][0] * __v88;
        let __v93 = __v92 - __v91;
        let __v94 = __v45 * __v93;
        let __v95 = __links[0][8] * __v59;
        let __v96 = __links[0][5] * __v75;
        let __v97 = __v95 + __v96;
        let __v98 = __v46 * __v80;
        let __v99 = __v97 - __v98;
        let __v100 = __v27 * __v99;
        let __v101 = __v100 - __v94;
        let __v102 = __sin_cos[0][2] * __v93;
        let __v103 = __sin_cos[0][3] * __v99;
        let __v104 = __v102 - __v103;
        let __v105 = __links[1][6] * __v104;
        let __v106 = __sin_cos[0][0] * __v82;
        let __v107 = __sin_cos[0][1] * __v88;
        let __v108 = __v106 + __v107;
        let __v109 = __links[1][0] * __v108;
        let __v110 = __sin_cos[0][3] * __v93;
        let __v111 = __sin_cos[0][2] * __v99;
        let __v112 = __v110 + __v111;
        let __v113 = __links[1][3] * __v112;
        let __v114 = __v113 - __v109;
        let __v115 = __v105 - __v114;
        let __v116 = __v5 * __v115;
        let __v117 = __links[1][8] * __v104;
        let __v118 = __links[1][2] * __v108;
        let __v119 = __links[1][5] * __v112;
        let __v120 = __v119 - __v118;
        let __v121 = __v120 - __v117;
        let __v122 = __v10 * __v121;
        let __v123 = __v116 + __v122;
        let __v124 = __sin_cos[1][1] * __v115;
        let __v125 = __sin_cos[1][0] * __v121;
        let __v126 = __v124 + __v125;
        let __v127 = __v15 * __v126;
        let __v128 = __links[1][7] * __v104;
        let __v129 = __links[1][1] * __v108;
        let __v130 = __links[1][4] * __v112;
        let __v131 = __v130 - __v129;
        let __v132 = __v131 - __v128;
        let __v133 = __v2 * __v132;
        let __v134 = __v127 + __v133;
        let __v135 = __links[0][1] * __v59;
        let __v136 = <S as ::aim::__private::Scalar>::constant(2.0) * __v70;
        let __v137 = __v74 * __v136;
        let __v138 = __links[0][4] * __v137;
        let __v139 = __v135 + __v138;
        let __v140 = __v79 * __v137;
        let __v141 = __v41 * __v140;
        let __v142 = __v139 - __v141;
        let __v143 = __v35 * __v142;
        let __v144 = __links[0][0] * __v59;
        let __v145 = __links[0][3] * __v137;
        let __v146 = __v144 + __v145;
        let __v147 = __v36 * __v140;
        let __v148 = __v146 - __v147;
        let __v149 = __v40 * __v148;
        let __v150 = __v143 + __v149;
        let __v151 = __sin_cos[0][1] * __v142;
        let __v152 = __sin_cos[0][0] * __v148;
        let __v153 = __v151 - __v152;
        let __v154 = __v45 * __v153;
        let __v155 = __links[0][2] * __v59;
        let __v156 = __links[0][5] * __v137;
        let __v157 = __v155 + __v156;
        let __v158 = __v46 * __v140;
        let __v159 = __v157 - __v158;
        let __v160 = __v27 * __v159;
        let __v161 = __v154 - __v160;
        let __v162 = __sin_cos[0][2] * __v153;
        let __v163 = __sin_cos[0][3] * __v159;
        let __v164 = __v162 - __v163;
        let __v165 = __links[1][6] * __v164;
        let __v166 = __sin_cos[0][0] * __v142;
        let __v167 = __sin_cos[0][1] * __v148;
        let __v168 = __v166 + __v167;
        let __v169 = __links[1][0] * __v168;
        let __v170 = __sin_cos[0][3] * __v153;
        let __v171 = __sin_cos[0][2] * __v159;
        let __v172 = __v170 + __v171;
        let __v173 = __links[1][3] * __v172;
        let __v174 = __v169 + __v173;
        let __v175 = __v165 - __v174;
        let __v176 = __v5 * __v175;
        let __v177 = __links[1][8] * __v164;
        let __v178 = __links[1][2] * __v168;
        let __v179 = __links[1][5] * __v172;
        let __v180 = __v178 + __v179;
        let __v181 = __v177 - __v180;
        let __v182 = __v10 * __v181;
        let __v183 = __v182 - __v176;
        let __v184 = __sin_cos[1][1] * __v175;
        let __v185 = __sin_cos[1][0] * __v181;
        let __v186 = __v184 - __v185;
        let __v187 = __v15 * __v186;
        let __v188 = __links[1][7] * __v164;
        let __v189 = __links[1][1] * __v168;
        let __v190 = __links[1][4] * __v172;
        let __v191 = __v189 + __v190;
        let __v192 = __v188 - __v191;
        let __v193 = __v2 * __v192;
        let __v194 = __v193 - __v187;
        [__v65, -__v71, __v90, __v101, __v123, __v134, __v150, __v161, __v183, __v194]
    }
};

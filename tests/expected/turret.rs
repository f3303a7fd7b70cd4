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
        fn array<T: ::core::marker::Copy>(&self, __value: T) -> [T; 2] {
            [__value; 2]
        }
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
        fn effector(&self) -> ::aim::__private::Effector {
            ::aim::__private::Effector {
                forward: [0.0, 0.0, -1.0],
                origin: [0.0, 0.05, -0.8],
            }
        }
        fn joints(&self) -> [::aim::__private::Joint; 2] {
            [self.barrel, self.base]
        }
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
        let __v0 = __target[2] * __sin_cos[0];
        let __v1 = __target[1] * __sin_cos[1];
        let __v2 = __v0 + __v1;
        let __v3 = __effector_to_joint[10] - __v2;
        let __v4 = __v3 * __v3;
        let __v5 = __target[2] * __sin_cos[1];
        let __v6 = __target[1] * __sin_cos[0];
        let __v7 = __v5 - __v6;
        let __v8 = __effector_to_joint[11] - __v7;
        let __v9 = __v8 * __v8;
        let __v10 = __effector_to_joint[9] - __target[0];
        let __v11 = __v10 * __v10;
        let __v12 = __v9 + __v11;
        let __v13 = __v4 + __v12;
        let __v14 = <S as ::aim::__private::Scalar>::sqrt(__v13);
        let __v15 = <S as ::aim::__private::Scalar>::constant(1.0) / __v14;
        let __v16 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v14,
            __v15,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v17 = __effector_to_joint[7] * __v3;
        let __v18 = __effector_to_joint[8] * __v8;
        let __v19 = __effector_to_joint[6] * __v10;
        let __v20 = __v18 + __v19;
        let __v21 = __v17 + __v20;
        let __v22 = __v16 * __v21;
        let __v23 = __v16 * __v22;
        let __v24 = __v8 * __v23;
        let __v25 = __effector_to_joint[8] - __v24;
        let __v26 = __v2 * __v25;
        let __v27 = __v3 * __v23;
        let __v28 = __effector_to_joint[7] - __v27;
        let __v29 = __v7 * __v28;
        let __v30 = __v26 - __v29;
        let __v31 = __v16 * __v30;
        [__v22, __v31, <S as ::aim::__private::Scalar>::ZERO]
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `base`. 31 operations: 12 add, 17 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
    #[inline]
    fn aim_gradient_1<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __effector_to_joint[10] - __target[1];
        let __v1 = __v0 * __v0;
        let __v2 = __target[2] * __sin_cos[3];
        let __v3 = __target[0] * __sin_cos[2];
        let __v4 = __v2 + __v3;
        let __v5 = __effector_to_joint[11] - __v4;
        let __v6 = __v5 * __v5;
        let __v7 = __target[2] * __sin_cos[2];
        let __v8 = __target[0] * __sin_cos[3];
        let __v9 = __v7 - __v8;
        let __v10 = __effector_to_joint[9] + __v9;
        let __v11 = __v10 * __v10;
        let __v12 = __v6 + __v11;
        let __v13 = __v1 + __v12;
        let __v14 = <S as ::aim::__private::Scalar>::sqrt(__v13);
        let __v15 = <S as ::aim::__private::Scalar>::constant(1.0) / __v14;
        let __v16 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v14,
            __v15,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v17 = __effector_to_joint[7] * __v0;
        let __v18 = __effector_to_joint[8] * __v5;
        let __v19 = __effector_to_joint[6] * __v10;
        let __v20 = __v18 + __v19;
        let __v21 = __v17 + __v20;
        let __v22 = __v16 * __v21;
        let __v23 = __v16 * __v22;
        let __v24 = __v5 * __v23;
        let __v25 = __effector_to_joint[8] - __v24;
        let __v26 = __v9 * __v25;
        let __v27 = __v10 * __v23;
        let __v28 = __effector_to_joint[6] - __v27;
        let __v29 = __v4 * __v28;
        let __v30 = __v26 + __v29;
        let __v31 = __v16 * __v30;
        [__v22, <S as ::aim::__private::Scalar>::ZERO, __v31]
    }
    ///The chain's aim, then its derivatives. 77 operations: 31 add, 44 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 3] {
        let __v0 = __target[2] * __sin_cos[1][3];
        let __v1 = __target[0] * __sin_cos[1][2];
        let __v2 = __v0 + __v1;
        let __v3 = __links[1][11] - __v2;
        let __v4 = __links[1][8] * __v3;
        let __v5 = __target[2] * __sin_cos[1][2];
        let __v6 = __target[0] * __sin_cos[1][3];
        let __v7 = __v5 - __v6;
        let __v8 = __links[1][9] + __v7;
        let __v9 = __links[1][6] * __v8;
        let __v10 = __links[1][10] - __target[1];
        let __v11 = __links[1][7] * __v10;
        let __v12 = __v9 + __v11;
        let __v13 = __v4 + __v12;
        let __v14 = __sin_cos[0][0] * __v13;
        let __v15 = __links[1][5] * __v3;
        let __v16 = __links[1][3] * __v8;
        let __v17 = __links[1][4] * __v10;
        let __v18 = __v16 + __v17;
        let __v19 = __v15 + __v18;
        let __v20 = __sin_cos[0][1] * __v19;
        let __v21 = __v14 + __v20;
        let __v22 = __links[0][10] + __v21;
        let __v23 = __v22 * __v22;
        let __v24 = __sin_cos[0][1] * __v13;
        let __v25 = __sin_cos[0][0] * __v19;
        let __v26 = __v24 - __v25;
        let __v27 = __links[0][11] + __v26;
        let __v28 = __v27 * __v27;
        let __v29 = __links[1][2] * __v3;
        let __v30 = __links[1][0] * __v8;
        let __v31 = __links[1][1] * __v10;
        let __v32 = __v30 + __v31;
        let __v33 = __v29 + __v32;
        let __v34 = __links[0][9] + __v33;
        let __v35 = __v34 * __v34;
        let __v36 = __v28 + __v35;
        let __v37 = __v23 + __v36;
        let __v38 = <S as ::aim::__private::Scalar>::sqrt(__v37);
        let __v39 = <S as ::aim::__private::Scalar>::constant(1.0) / __v38;
        let __v40 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v38,
            __v39,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v41 = __links[0][7] * __v22;
        let __v42 = __links[0][8] * __v27;
        let __v43 = __links[0][6] * __v34;
        let __v44 = __v42 + __v43;
        let __v45 = __v41 + __v44;
        let __v46 = __v40 * __v45;
        let __v47 = __v40 * __v46;
        let __v48 = __v27 * __v47;
        let __v49 = __links[0][8] - __v48;
        let __v50 = __v21 * __v49;
        let __v51 = __v22 * __v47;
        let __v52 = __links[0][7] - __v51;
        let __v53 = __v26 * __v52;
        let __v54 = __v53 - __v50;
        let __v55 = __v40 * __v54;
        let __v56 = __sin_cos[0][1] * __v49;
        let __v57 = __sin_cos[0][0] * __v52;
        let __v58 = __v56 + __v57;
        let __v59 = __links[1][8] * __v58;
        let __v60 = __v34 * __v47;
        let __v61 = __links[0][6] - __v60;
        let __v62 = __links[1][2] * __v61;
        let __v63 = __sin_cos[0][0] * __v49;
        let __v64 = __sin_cos[0][1] * __v52;
        let __v65 = __v63 - __v64;
        let __v66 = __links[1][5] * __v65;
        let __v67 = __v62 - __v66;
        let __v68 = __v59 + __v67;
        let __v69 = __v7 * __v68;
        let __v70 = __links[1][6] * __v58;
        let __v71 = __links[1][0] * __v61;
        let __v72 = __links[1][3] * __v65;
        let __v73 = __v71 - __v72;
        let __v74 = __v70 + __v73;
        let __v75 = __v2 * __v74;
        let __v76 = __v69 + __v75;
        let __v77 = __v40 * __v76;
        [__v46, __v55, __v77]
    }
    ///The chain's residual (left, up), then the derivatives of each. 141 operations: 53 add, 85 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Turret`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 6] {
        let __v0 = __target[2] * __sin_cos[1][3];
        let __v1 = __target[0] * __sin_cos[1][2];
        let __v2 = __v0 + __v1;
        let __v3 = __links[1][11] - __v2;
        let __v4 = __links[1][8] * __v3;
        let __v5 = __target[2] * __sin_cos[1][2];
        let __v6 = __target[0] * __sin_cos[1][3];
        let __v7 = __v6 - __v5;
        let __v8 = __links[1][9] - __v7;
        let __v9 = __links[1][6] * __v8;
        let __v10 = __links[1][10] - __target[1];
        let __v11 = __links[1][7] * __v10;
        let __v12 = __v9 + __v11;
        let __v13 = __v4 + __v12;
        let __v14 = __sin_cos[0][0] * __v13;
        let __v15 = __links[1][5] * __v3;
        let __v16 = __links[1][3] * __v8;
        let __v17 = __links[1][4] * __v10;
        let __v18 = __v16 + __v17;
        let __v19 = __v15 + __v18;
        let __v20 = __sin_cos[0][1] * __v19;
        let __v21 = __v14 + __v20;
        let __v22 = __links[0][10] + __v21;
        let __v23 = __v22 * __v22;
        let __v24 = __sin_cos[0][1] * __v13;
        let __v25 = __sin_cos[0][0] * __v19;
        let __v26 = __v24 - __v25;
        let __v27 = __links[0][11] + __v26;
        let __v28 = __v27 * __v27;
        let __v29 = __links[1][2] * __v3;
        let __v30 = __links[1][0] * __v8;
        let __v31 = __links[1][1] * __v10;
        let __v32 = __v30 + __v31;
        let __v33 = __v29 + __v32;
        let __v34 = __links[0][9] + __v33;
        let __v35 = __v34 * __v34;
        let __v36 = __v28 + __v35;
        let __v37 = __v23 + __v36;
        let __v38 = <S as ::aim::__private::Scalar>::sqrt(__v37);
        let __v39 = __links[0][8] * __v27;
        let __v40 = __links[0][6] * __v34;
        let __v41 = __links[0][7] * __v22;
        let __v42 = __v40 + __v41;
        let __v43 = __v39 + __v42;
        let __v44 = __v38 + __v43;
        let __v45 = <S as ::aim::__private::Scalar>::constant(1.0) / __v44;
        let __v46 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v44,
            __v45,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v47 = <S as ::aim::__private::Scalar>::constant(2.0) * __v46;
        let __v48 = __links[0][2] * __v27;
        let __v49 = __links[0][0] * __v34;
        let __v50 = __links[0][1] * __v22;
        let __v51 = __v49 + __v50;
        let __v52 = __v48 + __v51;
        let __v53 = __v47 * __v52;
        let __v54 = __links[0][5] * __v27;
        let __v55 = __links[0][3] * __v34;
        let __v56 = __links[0][4] * __v22;
        let __v57 = __v55 + __v56;
        let __v58 = __v54 + __v57;
        let __v59 = __v47 * __v58;
        let __v60 = __links[0][2] * __v47;
        let __v61 = <S as ::aim::__private::Scalar>::constant(2.0) * __v52;
        let __v62 = __v46 * __v46;
        let __v63 = __v61 * __v62;
        let __v64 = __links[0][8] * __v63;
        let __v65 = __v60 - __v64;
        let __v66 = <S as ::aim::__private::Scalar>::constant(1.0) / __v38;
        let __v67 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v38,
            __v66,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v68 = __v63 * __v67;
        let __v69 = __v27 * __v68;
        let __v70 = __v65 - __v69;
        let __v71 = __v21 * __v70;
        let __v72 = __links[0][1] * __v47;
        let __v73 = __links[0][7] * __v63;
        let __v74 = __v72 - __v73;
        let __v75 = __v22 * __v68;
        let __v76 = __v74 - __v75;
        let __v77 = __v26 * __v76;
        let __v78 = __v77 - __v71;
        let __v79 = __sin_cos[0][1] * __v70;
        let __v80 = __sin_cos[0][0] * __v76;
        let __v81 = __v79 + __v80;
        let __v82 = __links[1][8] * __v81;
        let __v83 = __links[0][0] * __v47;
        let __v84 = __links[0][6] * __v63;
        let __v85 = __v83 - __v84;
        let __v86 = __v34 * __v68;
        let __v87 = __v85 - __v86;
        let __v88 = __links[1][2] * __v87;
        let __v89 = __sin_cos[0][0] * __v70;
        let __v90 = __sin_cos[0][1] * __v76;
        let __v91 = __v89 - __v90;
        let __v92 = __links[1][5] * __v91;
        let __v93 = __v88 - __v92;
        let __v94 = __v82 + __v93;
        let __v95 = __v7 * __v94;
        let __v96 = __links[1][6] * __v81;
        let __v97 = __links[1][0] * __v87;
        let __v98 = __links[1][3] * __v91;
        let __v99 = __v97 - __v98;
        let __v100 = __v96 + __v99;
        let __v101 = __v2 * __v100;
        let __v102 = __v101 - __v95;
        let __v103 = __links[0][5] * __v47;
        let __v104 = <S as ::aim::__private::Scalar>::constant(2.0) * __v58;
        let __v105 = __v62 * __v104;
        let __v106 = __links[0][8] * __v105;
        let __v107 = __v103 - __v106;
        let __v108 = __v67 * __v105;
        let __v109 = __v27 * __v108;
        let __v110 = __v109 - __v107;
        let __v111 = __v21 * __v110;
        let __v112 = __links[0][4] * __v47;
        let __v113 = __links[0][7] * __v105;
        let __v114 = __v112 - __v113;
        let __v115 = __v22 * __v108;
        let __v116 = __v115 - __v114;
        let __v117 = __v26 * __v116;
        let __v118 = __v117 - __v111;
        let __v119 = __sin_cos[0][1] * __v110;
        let __v120 = __sin_cos[0][0] * __v116;
        let __v121 = __v119 + __v120;
        let __v122 = __links[1][8] * __v121;
        let __v123 = __links[0][3] * __v47;
        let __v124 = __links[0][6] * __v105;
        let __v125 = __v123 - __v124;
        let __v126 = __v34 * __v108;
        let __v127 = __v125 - __v126;
        let __v128 = __links[1][2] * __v127;
        let __v129 = __sin_cos[0][0] * __v110;
        let __v130 = __sin_cos[0][1] * __v116;
        let __v131 = __v130 - __v129;
        let __v132 = __links[1][5] * __v131;
        let __v133 = __v128 - __v132;
        let __v134 = __v133 - __v122;
        let __v135 = __v7 * __v134;
        let __v136 = __links[1][6] * __v121;
        let __v137 = __links[1][0] * __v127;
        let __v138 = __links[1][3] * __v131;
        let __v139 = __v138 - __v137;
        let __v140 = __v136 + __v139;
        let __v141 = __v2 * __v140;
        let __v142 = __v135 + __v141;
        [__v53, -__v59, __v78, __v102, __v118, __v142]
    }
};

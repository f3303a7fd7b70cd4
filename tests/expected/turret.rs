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
        let __v4 = __target[2] * __sin_cos[0];
        let __v7 = __target[1] * __sin_cos[1];
        let __v8 = __v4 + __v7;
        let __v9 = __effector_to_joint[10] - __v8;
        let __v10 = __v9 * __v9;
        let __v12 = __target[2] * __sin_cos[1];
        let __v13 = __target[1] * __sin_cos[0];
        let __v14 = __v12 - __v13;
        let __v15 = __effector_to_joint[11] - __v14;
        let __v16 = __v15 * __v15;
        let __v19 = __effector_to_joint[9] - __target[0];
        let __v20 = __v19 * __v19;
        let __v21 = __v16 + __v20;
        let __v22 = __v10 + __v21;
        let __v23 = <S as ::aim::__private::Scalar>::sqrt(__v22);
        let __v25 = <S as ::aim::__private::Scalar>::constant(1.0) / __v23;
        let __v27 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v23,
            __v25,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v29 = __effector_to_joint[7] * __v9;
        let __v31 = __effector_to_joint[8] * __v15;
        let __v33 = __effector_to_joint[6] * __v19;
        let __v34 = __v31 + __v33;
        let __v35 = __v29 + __v34;
        let __v36 = __v27 * __v35;
        let __v37 = __v27 * __v36;
        let __v38 = __v15 * __v37;
        let __v39 = __effector_to_joint[8] - __v38;
        let __v40 = __v8 * __v39;
        let __v41 = __v9 * __v37;
        let __v42 = __effector_to_joint[7] - __v41;
        let __v43 = __v14 * __v42;
        let __v44 = __v40 - __v43;
        let __v45 = __v27 * __v44;
        [__v36, __v45, <S as ::aim::__private::Scalar>::ZERO]
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `base`. 31 operations: 12 add, 17 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
    #[inline]
    fn aim_gradient_1<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v3 = __effector_to_joint[10] - __target[1];
        let __v4 = __v3 * __v3;
        let __v8 = __target[2] * __sin_cos[3];
        let __v11 = __target[0] * __sin_cos[2];
        let __v12 = __v8 + __v11;
        let __v13 = __effector_to_joint[11] - __v12;
        let __v14 = __v13 * __v13;
        let __v16 = __target[2] * __sin_cos[2];
        let __v17 = __target[0] * __sin_cos[3];
        let __v18 = __v16 - __v17;
        let __v19 = __effector_to_joint[9] + __v18;
        let __v20 = __v19 * __v19;
        let __v21 = __v14 + __v20;
        let __v22 = __v4 + __v21;
        let __v23 = <S as ::aim::__private::Scalar>::sqrt(__v22);
        let __v25 = <S as ::aim::__private::Scalar>::constant(1.0) / __v23;
        let __v27 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v23,
            __v25,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v29 = __effector_to_joint[7] * __v3;
        let __v31 = __effector_to_joint[8] * __v13;
        let __v33 = __effector_to_joint[6] * __v19;
        let __v34 = __v31 + __v33;
        let __v35 = __v29 + __v34;
        let __v36 = __v27 * __v35;
        let __v37 = __v27 * __v36;
        let __v38 = __v13 * __v37;
        let __v39 = __effector_to_joint[8] - __v38;
        let __v40 = __v18 * __v39;
        let __v41 = __v19 * __v37;
        let __v42 = __effector_to_joint[6] - __v41;
        let __v43 = __v12 * __v42;
        let __v44 = __v40 + __v43;
        let __v45 = __v27 * __v44;
        [__v36, <S as ::aim::__private::Scalar>::ZERO, __v45]
    }
    ///The chain's aim, then its derivatives. 77 operations: 31 add, 44 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Turret`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 3] {
        let __v7 = __target[2] * __sin_cos[1][3];
        let __v10 = __target[0] * __sin_cos[1][2];
        let __v11 = __v7 + __v10;
        let __v12 = __links[1][11] - __v11;
        let __v13 = __links[1][8] * __v12;
        let __v16 = __target[2] * __sin_cos[1][2];
        let __v17 = __target[0] * __sin_cos[1][3];
        let __v18 = __v16 - __v17;
        let __v19 = __links[1][9] + __v18;
        let __v20 = __links[1][6] * __v19;
        let __v24 = __links[1][10] - __target[1];
        let __v25 = __links[1][7] * __v24;
        let __v26 = __v20 + __v25;
        let __v27 = __v13 + __v26;
        let __v28 = __sin_cos[0][0] * __v27;
        let __v31 = __links[1][5] * __v12;
        let __v33 = __links[1][3] * __v19;
        let __v35 = __links[1][4] * __v24;
        let __v36 = __v33 + __v35;
        let __v37 = __v31 + __v36;
        let __v38 = __sin_cos[0][1] * __v37;
        let __v39 = __v28 + __v38;
        let __v40 = __links[0][10] + __v39;
        let __v41 = __v40 * __v40;
        let __v43 = __sin_cos[0][1] * __v27;
        let __v44 = __sin_cos[0][0] * __v37;
        let __v45 = __v43 - __v44;
        let __v46 = __links[0][11] + __v45;
        let __v47 = __v46 * __v46;
        let __v50 = __links[1][2] * __v12;
        let __v52 = __links[1][0] * __v19;
        let __v54 = __links[1][1] * __v24;
        let __v55 = __v52 + __v54;
        let __v56 = __v50 + __v55;
        let __v57 = __links[0][9] + __v56;
        let __v58 = __v57 * __v57;
        let __v59 = __v47 + __v58;
        let __v60 = __v41 + __v59;
        let __v61 = <S as ::aim::__private::Scalar>::sqrt(__v60);
        let __v63 = <S as ::aim::__private::Scalar>::constant(1.0) / __v61;
        let __v65 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v61,
            __v63,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v67 = __links[0][7] * __v40;
        let __v69 = __links[0][8] * __v46;
        let __v71 = __links[0][6] * __v57;
        let __v72 = __v69 + __v71;
        let __v73 = __v67 + __v72;
        let __v74 = __v65 * __v73;
        let __v75 = __v65 * __v74;
        let __v76 = __v46 * __v75;
        let __v77 = __links[0][8] - __v76;
        let __v78 = __v39 * __v77;
        let __v79 = __v40 * __v75;
        let __v80 = __links[0][7] - __v79;
        let __v81 = __v45 * __v80;
        let __v82 = __v78 - __v81;
        let __v83 = __v65 * __v82;
        let __v85 = __sin_cos[0][1] * __v77;
        let __v86 = __sin_cos[0][0] * __v80;
        let __v87 = __v85 + __v86;
        let __v88 = __links[1][8] * __v87;
        let __v89 = __v57 * __v75;
        let __v90 = __links[0][6] - __v89;
        let __v91 = __links[1][2] * __v90;
        let __v92 = __sin_cos[0][0] * __v77;
        let __v93 = __sin_cos[0][1] * __v80;
        let __v94 = __v92 - __v93;
        let __v95 = __links[1][5] * __v94;
        let __v96 = __v91 - __v95;
        let __v97 = __v88 + __v96;
        let __v98 = __v18 * __v97;
        let __v99 = __links[1][6] * __v87;
        let __v100 = __links[1][0] * __v90;
        let __v101 = __links[1][3] * __v94;
        let __v102 = __v100 - __v101;
        let __v103 = __v99 + __v102;
        let __v104 = __v11 * __v103;
        let __v105 = __v98 + __v104;
        let __v106 = __v65 * __v105;
        [__v74, -__v83, __v106]
    }
    ///The chain's residual (left, up), then the derivatives of each. 141 operations: 53 add, 85 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Turret`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 6] {
        let __v8 = __target[2] * __sin_cos[1][3];
        let __v11 = __target[0] * __sin_cos[1][2];
        let __v12 = __v8 + __v11;
        let __v13 = __links[1][11] - __v12;
        let __v14 = __links[1][8] * __v13;
        let __v17 = __target[2] * __sin_cos[1][2];
        let __v18 = __target[0] * __sin_cos[1][3];
        let __v19 = __v17 - __v18;
        let __v20 = __links[1][9] + __v19;
        let __v21 = __links[1][6] * __v20;
        let __v25 = __links[1][10] - __target[1];
        let __v26 = __links[1][7] * __v25;
        let __v27 = __v21 + __v26;
        let __v28 = __v14 + __v27;
        let __v29 = __sin_cos[0][0] * __v28;
        let __v32 = __links[1][5] * __v13;
        let __v34 = __links[1][3] * __v20;
        let __v36 = __links[1][4] * __v25;
        let __v37 = __v34 + __v36;
        let __v38 = __v32 + __v37;
        let __v39 = __sin_cos[0][1] * __v38;
        let __v40 = __v29 + __v39;
        let __v41 = __links[0][10] + __v40;
        let __v42 = __v41 * __v41;
        let __v44 = __sin_cos[0][1] * __v28;
        let __v45 = __sin_cos[0][0] * __v38;
        let __v46 = __v44 - __v45;
        let __v47 = __links[0][11] + __v46;
        let __v48 = __v47 * __v47;
        let __v51 = __links[1][2] * __v13;
        let __v53 = __links[1][0] * __v20;
        let __v55 = __links[1][1] * __v25;
        let __v56 = __v53 + __v55;
        let __v57 = __v51 + __v56;
        let __v58 = __links[0][9] + __v57;
        let __v59 = __v58 * __v58;
        let __v60 = __v48 + __v59;
        let __v61 = __v42 + __v60;
        let __v62 = <S as ::aim::__private::Scalar>::sqrt(__v61);
        let __v64 = __links[0][8] * __v47;
        let __v66 = __links[0][6] * __v58;
        let __v68 = __links[0][7] * __v41;
        let __v69 = __v66 + __v68;
        let __v70 = __v64 + __v69;
        let __v71 = __v62 + __v70;
        let __v73 = <S as ::aim::__private::Scalar>::constant(1.0) / __v71;
        let __v75 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v71,
            __v73,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v76 = <S as ::aim::__private::Scalar>::constant(2.0) * __v75;
        let __v78 = __links[0][2] * __v47;
        let __v80 = __links[0][0] * __v58;
        let __v82 = __links[0][1] * __v41;
        let __v83 = __v80 + __v82;
        let __v84 = __v78 + __v83;
        let __v85 = __v76 * __v84;
        let __v87 = __links[0][5] * __v47;
        let __v89 = __links[0][3] * __v58;
        let __v91 = __links[0][4] * __v41;
        let __v92 = __v89 + __v91;
        let __v93 = __v87 + __v92;
        let __v94 = __v76 * __v93;
        let __v96 = __links[0][2] * __v76;
        let __v97 = <S as ::aim::__private::Scalar>::constant(2.0) * __v84;
        let __v98 = __v75 * __v75;
        let __v99 = __v97 * __v98;
        let __v100 = __links[0][8] * __v99;
        let __v101 = __v96 - __v100;
        let __v102 = <S as ::aim::__private::Scalar>::constant(1.0) / __v62;
        let __v103 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v62,
            __v102,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v104 = __v99 * __v103;
        let __v105 = __v47 * __v104;
        let __v106 = __v101 - __v105;
        let __v107 = __v40 * __v106;
        let __v108 = __links[0][1] * __v76;
        let __v109 = __links[0][7] * __v99;
        let __v110 = __v108 - __v109;
        let __v111 = __v41 * __v104;
        let __v112 = __v110 - __v111;
        let __v113 = __v46 * __v112;
        let __v114 = __v107 - __v113;
        let __v116 = __sin_cos[0][1] * __v106;
        let __v117 = __sin_cos[0][0] * __v112;
        let __v118 = __v116 + __v117;
        let __v119 = __links[1][8] * __v118;
        let __v120 = __links[0][0] * __v76;
        let __v121 = __links[0][6] * __v99;
        let __v122 = __v120 - __v121;
        let __v123 = __v58 * __v104;
        let __v124 = __v122 - __v123;
        let __v125 = __links[1][2] * __v124;
        let __v126 = __sin_cos[0][0] * __v106;
        let __v127 = __sin_cos[0][1] * __v112;
        let __v128 = __v126 - __v127;
        let __v129 = __links[1][5] * __v128;
        let __v130 = __v125 - __v129;
        let __v131 = __v119 + __v130;
        let __v132 = __v19 * __v131;
        let __v133 = __links[1][6] * __v118;
        let __v134 = __links[1][0] * __v124;
        let __v135 = __links[1][3] * __v128;
        let __v136 = __v134 - __v135;
        let __v137 = __v133 + __v136;
        let __v138 = __v12 * __v137;
        let __v139 = __v132 + __v138;
        let __v140 = __links[0][5] * __v76;
        let __v141 = <S as ::aim::__private::Scalar>::constant(2.0) * __v93;
        let __v142 = __v98 * __v141;
        let __v143 = __links[0][8] * __v142;
        let __v144 = __v140 - __v143;
        let __v145 = __v103 * __v142;
        let __v146 = __v47 * __v145;
        let __v147 = __v144 - __v146;
        let __v148 = __v40 * __v147;
        let __v149 = __links[0][4] * __v76;
        let __v150 = __links[0][7] * __v142;
        let __v151 = __v149 - __v150;
        let __v152 = __v41 * __v145;
        let __v153 = __v151 - __v152;
        let __v154 = __v46 * __v153;
        let __v155 = __v148 - __v154;
        let __v156 = __sin_cos[0][1] * __v147;
        let __v157 = __sin_cos[0][0] * __v153;
        let __v158 = __v156 + __v157;
        let __v159 = __links[1][8] * __v158;
        let __v160 = __links[0][3] * __v76;
        let __v161 = __links[0][6] * __v142;
        let __v162 = __v160 - __v161;
        let __v163 = __v58 * __v145;
        let __v164 = __v162 - __v163;
        let __v165 = __links[1][2] * __v164;
        let __v166 = __sin_cos[0][0] * __v147;
        let __v167 = __sin_cos[0][1] * __v153;
        let __v168 = __v166 - __v167;
        let __v169 = __links[1][5] * __v168;
        let __v170 = __v165 - __v169;
        let __v171 = __v159 + __v170;
        let __v172 = __v19 * __v171;
        let __v173 = __links[1][6] * __v158;
        let __v174 = __links[1][0] * __v164;
        let __v175 = __links[1][3] * __v168;
        let __v176 = __v174 - __v175;
        let __v177 = __v173 + __v176;
        let __v178 = __v12 * __v177;
        let __v179 = __v172 + __v178;
        [__v85, -__v94, -__v114, __v139, __v155, -__v179]
    }
};

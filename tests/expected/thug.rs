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
    impl Thug {
        /// The names that each joint's bone may have in a model, from the effector inward.
        #[allow(
            dead_code,
            unreachable_pub,
            reason = "a rig need not be looked up by its bones' names"
        )]
        pub const BONES: [&'static [&'static ::core::primitive::str]; 3] = [
            &["left_eye"],
            &["neck"],
            &["spine3"],
        ];
    }
    #[automatically_derived]
    impl ::core::default::Default for Thug {
        /// At rest: every angle 0.
        fn default() -> Self {
            Self {
                left_eye: ::core::default::Default::default(),
                neck: ::core::default::Default::default(),
                spine3: ::core::default::Default::default(),
            }
        }
    }
    #[automatically_derived]
    impl ::core::fmt::Debug for Thug {
        fn fmt(
            &self,
            __formatter: &mut ::core::fmt::Formatter<'_>,
        ) -> ::core::fmt::Result {
            ::core::fmt::DebugStruct::finish(
                ::core::fmt::DebugStruct::field(
                    ::core::fmt::DebugStruct::field(
                        ::core::fmt::DebugStruct::field(
                            &mut ::core::fmt::Formatter::debug_struct(
                                __formatter,
                                "Thug",
                            ),
                            "left_eye",
                            &self.left_eye,
                        ),
                        "neck",
                        &self.neck,
                    ),
                    "spine3",
                    &self.spine3,
                ),
            )
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for Thug {
        type Array<T: ::core::marker::Copy> = [T; 3];
        fn array<T: ::core::marker::Copy>(&self, __value: T) -> [T; 3] {
            [__value; 3]
        }
        fn joint_infos(&self) -> &[::aim::__private::JointInfo] {
            const INFOS: [::aim::__private::JointInfo; 3] = [
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
                    .with_comfort(0.5),
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
                    .with_comfort(1.0),
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
                    .with_comfort(4.0),
            ];
            &INFOS
        }
        fn effector(&self) -> ::aim::__private::Effector {
            ::aim::__private::Effector {
                forward: [0.0, 1.0, 0.0],
                origin: [0.0, 0.0, 0.0],
            }
        }
        fn joints(&self) -> [::aim::__private::Joint; 3] {
            [self.left_eye, self.neck, self.spine3]
        }
        fn set_joints(&mut self, __states: [::aim::__private::Joint; 3]) {
            [self.left_eye, self.neck, self.spine3] = __states;
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
                0 | 1 | 2 => aim_gradient_0(__effector_to_joint, __target, __sin_cos),
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
                <&[[S; 12]; 3] as ::core::convert::TryFrom<
                    &[[S; 12]],
                >>::try_from(__links),
                <&[[S; 4]; 3] as ::core::convert::TryFrom<
                    &[[S; 4]],
                >>::try_from(__sin_cos),
                <&mut [S; 7] as ::core::convert::TryFrom<
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
                <&[[S; 12]; 3] as ::core::convert::TryFrom<
                    &[[S; 12]],
                >>::try_from(__links),
                <&[[S; 4]; 3] as ::core::convert::TryFrom<
                    &[[S; 4]],
                >>::try_from(__sin_cos),
                <&mut [S; 14] as ::core::convert::TryFrom<
                    &mut [S],
                >>::try_from(&mut *__out),
            ) {
                *__out = residual_jacobian(__links, __target, __sin_cos);
            } else {
                <[S]>::fill(__out, <S as ::aim::__private::Scalar>::ZERO);
            }
        }
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `left_eye`, `neck`, `spine3`. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Thug`.
    #[inline]
    fn aim_gradient_0<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __target[1] * __sin_cos[3];
        let __v1 = __target[2] * __sin_cos[2];
        let __v2 = __v0 + __v1;
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
        let __v15 = __v14 - __v13;
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
        let __v45 = __v41 - __v44;
        let __v46 = __v22 * __v45;
        [__v28, __v37, __v46]
    }
    ///The chain's aim, then its derivatives. 173 operations: 67 add, 104 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Thug`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 3],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 3],
    ) -> [S; 7] {
        let __v0 = __target[1] * __sin_cos[2][2];
        let __v1 = __target[2] * __sin_cos[2][3];
        let __v2 = __v1 - __v0;
        let __v3 = __v2 - __links[2][11];
        let __v4 = __links[2][5] * __v3;
        let __v5 = __target[1] * __sin_cos[2][3];
        let __v6 = __target[2] * __sin_cos[2][2];
        let __v7 = __v5 + __v6;
        let __v8 = __sin_cos[2][0] * __v7;
        let __v9 = __target[0] * __sin_cos[2][1];
        let __v10 = __v9 - __v8;
        let __v11 = __v10 - __links[2][9];
        let __v12 = __links[2][3] * __v11;
        let __v13 = __sin_cos[2][1] * __v7;
        let __v14 = __target[0] * __sin_cos[2][0];
        let __v15 = __v13 + __v14;
        let __v16 = __v15 - __links[2][10];
        let __v17 = __links[2][4] * __v16;
        let __v18 = __v12 + __v17;
        let __v19 = __v4 + __v18;
        let __v20 = __sin_cos[1][2] * __v19;
        let __v21 = __links[2][8] * __v3;
        let __v22 = __links[2][6] * __v11;
        let __v23 = __links[2][7] * __v16;
        let __v24 = __v22 + __v23;
        let __v25 = __v21 + __v24;
        let __v26 = __sin_cos[1][3] * __v25;
        let __v27 = __v26 - __v20;
        let __v28 = __v27 - __links[1][11];
        let __v29 = __links[1][5] * __v28;
        let __v30 = __sin_cos[1][3] * __v19;
        let __v31 = __sin_cos[1][2] * __v25;
        let __v32 = __v30 + __v31;
        let __v33 = __sin_cos[1][0] * __v32;
        let __v34 = __links[2][2] * __v3;
        let __v35 = __links[2][0] * __v11;
        let __v36 = __links[2][1] * __v16;
        let __v37 = __v35 + __v36;
        let __v38 = __v34 + __v37;
        let __v39 = __sin_cos[1][1] * __v38;
        let __v40 = __v39 - __v33;
        let __v41 = __v40 - __links[1][9];
        let __v42 = __links[1][3] * __v41;
        let __v43 = __sin_cos[1][1] * __v32;
        let __v44 = __sin_cos[1][0] * __v38;
        let __v45 = __v43 + __v44;
        let __v46 = __v45 - __links[1][10];
        let __v47 = __links[1][4] * __v46;
        let __v48 = __v42 + __v47;
        let __v49 = __v29 + __v48;
        let __v50 = __sin_cos[0][3] * __v49;
        let __v51 = __links[1][8] * __v28;
        let __v52 = __links[1][6] * __v41;
        let __v53 = __links[1][7] * __v46;
        let __v54 = __v52 + __v53;
        let __v55 = __v51 + __v54;
        let __v56 = __sin_cos[0][2] * __v55;
        let __v57 = __v50 + __v56;
        let __v58 = __sin_cos[0][0] * __v57;
        let __v59 = __links[1][2] * __v28;
        let __v60 = __links[1][0] * __v41;
        let __v61 = __links[1][1] * __v46;
        let __v62 = __v60 + __v61;
        let __v63 = __v59 + __v62;
        let __v64 = __sin_cos[0][1] * __v63;
        let __v65 = __v64 - __v58;
        let __v66 = __v65 - __links[0][9];
        let __v67 = __v66 * __v66;
        let __v68 = __sin_cos[0][1] * __v57;
        let __v69 = __sin_cos[0][0] * __v63;
        let __v70 = __v68 + __v69;
        let __v71 = __v70 - __links[0][10];
        let __v72 = __v71 * __v71;
        let __v73 = __sin_cos[0][2] * __v49;
        let __v74 = __sin_cos[0][3] * __v55;
        let __v75 = __v74 - __v73;
        let __v76 = __v75 - __links[0][11];
        let __v77 = __v76 * __v76;
        let __v78 = __v72 + __v77;
        let __v79 = __v67 + __v78;
        let __v80 = <S as ::aim::__private::Scalar>::sqrt(__v79);
        let __v81 = <S as ::aim::__private::Scalar>::constant(1.0) / __v80;
        let __v82 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v80,
            __v81,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v83 = __links[0][3] * __v66;
        let __v84 = __links[0][4] * __v71;
        let __v85 = __links[0][5] * __v76;
        let __v86 = __v84 + __v85;
        let __v87 = __v83 + __v86;
        let __v88 = __v82 * __v87;
        let __v89 = __v82 * __v88;
        let __v90 = __v71 * __v89;
        let __v91 = __links[0][4] - __v90;
        let __v92 = __v82 * __v91;
        let __v93 = __v65 * __v92;
        let __v94 = __v66 * __v89;
        let __v95 = __links[0][3] - __v94;
        let __v96 = __v82 * __v95;
        let __v97 = __v70 * __v96;
        let __v98 = __v93 - __v97;
        let __v99 = __sin_cos[0][1] * __v92;
        let __v100 = __sin_cos[0][0] * __v96;
        let __v101 = __v99 - __v100;
        let __v102 = __v75 * __v101;
        let __v103 = __v76 * __v89;
        let __v104 = __links[0][5] - __v103;
        let __v105 = __v82 * __v104;
        let __v106 = __v57 * __v105;
        let __v107 = __v102 - __v106;
        let __v108 = __sin_cos[0][2] * __v101;
        let __v109 = __sin_cos[0][3] * __v105;
        let __v110 = __v108 + __v109;
        let __v111 = __links[1][7] * __v110;
        let __v112 = __sin_cos[0][0] * __v92;
        let __v113 = __sin_cos[0][1] * __v96;
        let __v114 = __v112 + __v113;
        let __v115 = __links[1][1] * __v114;
        let __v116 = __sin_cos[0][3] * __v101;
        let __v117 = __sin_cos[0][2] * __v105;
        let __v118 = __v116 - __v117;
        let __v119 = __links[1][4] * __v118;
        let __v120 = __v115 + __v119;
        let __v121 = __v111 + __v120;
        let __v122 = __v40 * __v121;
        let __v123 = __links[1][6] * __v110;
        let __v124 = __links[1][0] * __v114;
        let __v125 = __links[1][3] * __v118;
        let __v126 = __v124 + __v125;
        let __v127 = __v123 + __v126;
        let __v128 = __v45 * __v127;
        let __v129 = __v122 - __v128;
        let __v130 = __sin_cos[1][1] * __v121;
        let __v131 = __sin_cos[1][0] * __v127;
        let __v132 = __v130 - __v131;
        let __v133 = __v27 * __v132;
        let __v134 = __links[1][8] * __v110;
        let __v135 = __links[1][2] * __v114;
        let __v136 = __links[1][5] * __v118;
        let __v137 = __v135 + __v136;
        let __v138 = __v134 + __v137;
        let __v139 = __v32 * __v138;
        let __v140 = __v133 - __v139;
        let __v141 = __sin_cos[1][2] * __v132;
        let __v142 = __sin_cos[1][3] * __v138;
        let __v143 = __v141 + __v142;
        let __v144 = __links[2][7] * __v143;
        let __v145 = __sin_cos[1][0] * __v121;
        let __v146 = __sin_cos[1][1] * __v127;
        let __v147 = __v145 + __v146;
        let __v148 = __links[2][1] * __v147;
        let __v149 = __sin_cos[1][3] * __v132;
        let __v150 = __sin_cos[1][2] * __v138;
        let __v151 = __v149 - __v150;
        let __v152 = __links[2][4] * __v151;
        let __v153 = __v148 + __v152;
        let __v154 = __v144 + __v153;
        let __v155 = __v10 * __v154;
        let __v156 = __links[2][6] * __v143;
        let __v157 = __links[2][0] * __v147;
        let __v158 = __links[2][3] * __v151;
        let __v159 = __v157 + __v158;
        let __v160 = __v156 + __v159;
        let __v161 = __v15 * __v160;
        let __v162 = __v155 - __v161;
        let __v163 = __sin_cos[2][1] * __v154;
        let __v164 = __sin_cos[2][0] * __v160;
        let __v165 = __v163 - __v164;
        let __v166 = __v2 * __v165;
        let __v167 = __links[2][8] * __v143;
        let __v168 = __links[2][2] * __v147;
        let __v169 = __links[2][5] * __v151;
        let __v170 = __v168 + __v169;
        let __v171 = __v167 + __v170;
        let __v172 = __v7 * __v171;
        let __v173 = __v166 - __v172;
        [__v88, __v98, __v107, __v129, __v140, __v162, __v173]
    }
    ///The chain's residual (left, up), then the derivatives of each. 289 operations: 108 add, 178 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Thug`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 3],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 3],
    ) -> [S; 14] {
        let __v0 = __target[1] * __sin_cos[2][2];
        let __v1 = __target[2] * __sin_cos[2][3];
        let __v2 = __v1 - __v0;
        let __v3 = __v2 - __links[2][11];
        let __v4 = __links[2][5] * __v3;
        let __v5 = __target[1] * __sin_cos[2][3];
        let __v6 = __target[2] * __sin_cos[2][2];
        let __v7 = __v5 + __v6;
        let __v8 = __sin_cos[2][0] * __v7;
        let __v9 = __target[0] * __sin_cos[2][1];
        let __v10 = __v9 - __v8;
        let __v11 = __v10 - __links[2][9];
        let __v12 = __links[2][3] * __v11;
        let __v13 = __sin_cos[2][1] * __v7;
        let __v14 = __target[0] * __sin_cos[2][0];
        let __v15 = __v13 + __v14;
        let __v16 = __v15 - __links[2][10];
        let __v17 = __links[2][4] * __v16;
        let __v18 = __v12 + __v17;
        let __v19 = __v4 + __v18;
        let __v20 = __sin_cos[1][2] * __v19;
        let __v21 = __links[2][8] * __v3;
        let __v22 = __links[2][6] * __v11;
        let __v23 = __links[2][7] * __v16;
        let __v24 = __v22 + __v23;
        let __v25 = __v21 + __v24;
        let __v26 = __sin_cos[1][3] * __v25;
        let __v27 = __v26 - __v20;
        let __v28 = __v27 - __links[1][11];
        let __v29 = __links[1][5] * __v28;
        let __v30 = __sin_cos[1][3] * __v19;
        let __v31 = __sin_cos[1][2] * __v25;
        let __v32 = __v30 + __v31;
        let __v33 = __sin_cos[1][0] * __v32;
        let __v34 = __links[2][2] * __v3;
        let __v35 = __links[2][0] * __v11;
        let __v36 = __links[2][1] * __v16;
        let __v37 = __v35 + __v36;
        let __v38 = __v34 + __v37;
        let __v39 = __sin_cos[1][1] * __v38;
        let __v40 = __v39 - __v33;
        let __v41 = __v40 - __links[1][9];
        let __v42 = __links[1][3] * __v41;
        let __v43 = __sin_cos[1][1] * __v32;
        let __v44 = __sin_cos[1][0] * __v38;
        let __v45 = __v43 + __v44;
        let __v46 = __v45 - __links[1][10];
        let __v47 = __links[1][4] * __v46;
        let __v48 = __v42 + __v47;
        let __v49 = __v29 + __v48;
        let __v50 = __sin_cos[0][3] * __v49;
        let __v51 = __links[1][8] * __v28;
        let __v52 = __links[1][6] * __v41;
        let __v53 = __links[1][7] * __v46;
        let __v54 = __v52 + __v53;
        let __v55 = __v51 + __v54;
        let __v56 = __sin_cos[0][2] * __v55;
        let __v57 = __v50 + __v56;
        let __v58 = __sin_cos[0][0] * __v57;
        let __v59 = __links[1][2] * __v28;
        let __v60 = __links[1][0] * __v41;
        let __v61 = __links[1][1] * __v46;
        let __v62 = __v60 + __v61;
        let __v63 = __v59 + __v62;
        let __v64 = __sin_cos[0][1] * __v63;
        let __v65 = __v64 - __v58;
        let __v66 = __v65 - __links[0][9];
        let __v67 = __v66 * __v66;
        let __v68 = __sin_cos[0][1] * __v57;
        let __v69 = __sin_cos[0][0] * __v63;
        let __v70 = __v68 + __v69;
        let __v71 = __v70 - __links[0][10];
        let __v72 = __v71 * __v71;
        let __v73 = __sin_cos[0][2] * __v49;
        let __v74 = __sin_cos[0][3] * __v55;
        let __v75 = __v74 - __v73;
        let __v76 = __v75 - __links[0][11];
        let __v77 = __v76 * __v76;
        let __v78 = __v72 + __v77;
        let __v79 = __v67 + __v78;
        let __v80 = <S as ::aim::__private::Scalar>::sqrt(__v79);
        let __v81 = __links[0][5] * __v76;
        let __v82 = __links[0][3] * __v66;
        let __v83 = __links[0][4] * __v71;
        let __v84 = __v82 + __v83;
        let __v85 = __v81 + __v84;
        let __v86 = __v80 + __v85;
        let __v87 = <S as ::aim::__private::Scalar>::constant(1.0) / __v86;
        let __v88 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v86,
            __v87,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v89 = <S as ::aim::__private::Scalar>::constant(2.0) * __v88;
        let __v90 = __links[0][8] * __v76;
        let __v91 = __links[0][6] * __v66;
        let __v92 = __links[0][7] * __v71;
        let __v93 = __v91 + __v92;
        let __v94 = __v90 + __v93;
        let __v95 = __v89 * __v94;
        let __v96 = __links[0][2] * __v76;
        let __v97 = __links[0][0] * __v66;
        let __v98 = __links[0][1] * __v71;
        let __v99 = __v97 + __v98;
        let __v100 = __v96 + __v99;
        let __v101 = __v89 * __v100;
        let __v102 = __links[0][7] * __v89;
        let __v103 = <S as ::aim::__private::Scalar>::constant(2.0) * __v94;
        let __v104 = __v88 * __v88;
        let __v105 = __v103 * __v104;
        let __v106 = __links[0][4] * __v105;
        let __v107 = __v102 - __v106;
        let __v108 = <S as ::aim::__private::Scalar>::constant(1.0) / __v80;
        let __v109 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v80,
            __v108,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v110 = __v105 * __v109;
        let __v111 = __v71 * __v110;
        let __v112 = __v107 - __v111;
        let __v113 = __v65 * __v112;
        let __v114 = __links[0][6] * __v89;
        let __v115 = __links[0][3] * __v105;
        let __v116 = __v114 - __v115;
        let __v117 = __v66 * __v110;
        let __v118 = __v116 - __v117;
        let __v119 = __v70 * __v118;
        let __v120 = __v113 - __v119;
        let __v121 = __sin_cos[0][1] * __v112;
        let __v122 = __sin_cos[0][0] * __v118;
        let __v123 = __v121 - __v122;
        let __v124 = __v75 * __v123;
        let __v125 = __links[0][8] * __v89;
        let __v126 = __links[0][5] * __v105;
        let __v127 = __v125 - __v126;
        let __v128 = __v76 * __v110;
        let __v129 = __v127 - __v128;
        let __v130 = __v57 * __v129;
        let __v131 = __v124 - __v130;
        let __v132 = __sin_cos[0][2] * __v123;
        let __v133 = __sin_cos[0][3] * __v129;
        let __v134 = __v132 + __v133;
        let __v135 = __links[1][7] * __v134;
        let __v136 = __sin_cos[0][0] * __v112;
        let __v137 = __sin_cos[0][1] * __v118;
        let __v138 = __v136 + __v137;
        let __v139 = __links[1][1] * __v138;
        let __v140 = __sin_cos[0][3] * __v123;
        let __v141 = __sin_cos[0][2] * __v129;
        let __v142 = __v140 - __v141;
        let __v143 = __links[1][4] * __v142;
        let __v144 = __v139 + __v143;
        let __v145 = __v135 + __v144;
        let __v146 = __v40 * __v145;
        let __v147 = __links[1][6] * __v134;
        let __v148 = __links[1][0] * __v138;
        let __v149 = __links[1][3] * __v142;
        let __v150 = __v148 + __v149;
        let __v151 = __v147 + __v150;
        let __v152 = __v45 * __v151;
        let __v153 = __v146 - __v152;
        let __v154 = __sin_cos[1][1] * __v145;
        let __v155 = __sin_cos[1][0] * __v151;
        let __v156 = __v154 - __v155;
        let __v157 = __v27 * __v156;
        let __v158 = __links[1][8] * __v134;
        let __v159 = __links[1][2] * __v138;
        let __v160 = __links[1][5] * __v142;
        let __v161 = __v159 + __v160;
        let __v162 = __v158 + __v161;
        let __v163 = __v32 * __v162;
        let __v164 = __v157 - __v163;
        let __v165 = __sin_cos[1][2] * __v156;
        let __v166 = __sin_cos[1][3] * __v162;
        let __v167 = __v165 + __v166;
        let __v168 = __links[2][7] * __v167;
        let __v169 = __sin_cos[1][0] * __v145;
        let __v170 = __sin_cos[1][1] * __v151;
        let __v171 = __v169 + __v170;
        let __v172 = __links[2][1] * __v171;
        let __v173 = __sin_cos[1][3] * __v156;
        let __v174 = __sin_cos[1][2] * __v162;
        let __v175 = __v173 - __v174;
        let __v176 = __links[2][4] * __v175;
        let __v177 = __v172 + __v176;
        let __v178 = __v168 + __v177;
        let __v179 = __v10 * __v178;
        let __v180 = __links[2][6] * __v167;
        let __v181 = __links[2][0] * __v171;
        let __v182 = __links[2][3] * __v175;
        let __v183 = __v181 + __v182;
        let __v184 = __v180 + __v183;
        let __v185 = __v15 * __v184;
        let __v186 = __v179 - __v185;
        let __v187 = __sin_cos[2][1] * __v178;
        let __v188 = __sin_cos[2][0] * __v184;
        let __v189 = __v187 - __v188;
        let __v190 = __v2 * __v189;
        let __v191 = __links[2][8] * __v167;
        let __v192 = __links[2][2] * __v171;
        let __v193 = __links[2][5] * __v175;
        let __v194 = __v192 + __v193;
        let __v195 = __v191 + __v194;
        let __v196 = __v7 * __v195;
        let __v197 = __v190 - __v196;
        let __v198 = __links[0][1] * __v89;
        let __v199 = <S as ::aim::__private::Scalar>::constant(2.0) * __v100;
        let __v200 = __v104 * __v199;
        let __v201 = __links[0][4] * __v200;
        let __v202 = __v198 - __v201;
        let __v203 = __v109 * __v200;
        let __v204 = __v71 * __v203;
        let __v205 = __v202 - __v204;
        let __v206 = __v65 * __v205;
        let __v207 = __links[0][0] * __v89;
        let __v208 = __links[0][3] * __v200;
        let __v209 = __v207 - __v208;
        let __v210 = __v66 * __v203;
        let __v211 = __v209 - __v210;
        let __v212 = __v70 * __v211;
        let __v213 = __v206 - __v212;
        let __v214 = __sin_cos[0][1] * __v205;
        let __v215 = __sin_cos[0][0] * __v211;
        let __v216 = __v214 - __v215;
        let __v217 = __v75 * __v216;
        let __v218 = __links[0][2] * __v89;
        let __v219 = __links[0][5] * __v200;
        let __v220 = __v218 - __v219;
        let __v221 = __v76 * __v203;
        let __v222 = __v220 - __v221;
        let __v223 = __v57 * __v222;
        let __v224 = __v217 - __v223;
        let __v225 = __sin_cos[0][2] * __v216;
        let __v226 = __sin_cos[0][3] * __v222;
        let __v227 = __v225 + __v226;
        let __v228 = __links[1][7] * __v227;
        let __v229 = __sin_cos[0][0] * __v205;
        let __v230 = __sin_cos[0][1] * __v211;
        let __v231 = __v229 + __v230;
        let __v232 = __links[1][1] * __v231;
        let __v233 = __sin_cos[0][3] * __v216;
        let __v234 = __sin_cos[0][2] * __v222;
        let __v235 = __v233 - __v234;
        let __v236 = __links[1][4] * __v235;
        let __v237 = __v232 + __v236;
        let __v238 = __v228 + __v237;
        let __v239 = __v40 * __v238;
        let __v240 = __links[1][6] * __v227;
        let __v241 = __links[1][0] * __v231;
        let __v242 = __links[1][3] * __v235;
        let __v243 = __v241 + __v242;
        let __v244 = __v240 + __v243;
        let __v245 = __v45 * __v244;
        let __v246 = __v239 - __v245;
        let __v247 = __sin_cos[1][1] * __v238;
        let __v248 = __sin_cos[1][0] * __v244;
        let __v249 = __v247 - __v248;
        let __v250 = __v27 * __v249;
        let __v251 = __links[1][8] * __v227;
        let __v252 = __links[1][2] * __v231;
        let __v253 = __links[1][5] * __v235;
        let __v254 = __v252 + __v253;
        let __v255 = __v251 + __v254;
        let __v256 = __v32 * __v255;
        let __v257 = __v250 - __v256;
        let __v258 = __sin_cos[1][2] * __v249;
        let __v259 = __sin_cos[1][3] * __v255;
        let __v260 = __v258 + __v259;
        let __v261 = __links[2][7] * __v260;
        let __v262 = __sin_cos[1][0] * __v238;
        let __v263 = __sin_cos[1][1] * __v244;
        let __v264 = __v262 + __v263;
        let __v265 = __links[2][1] * __v264;
        let __v266 = __sin_cos[1][3] * __v249;
        let __v267 = __sin_cos[1][2] * __v255;
        let __v268 = __v266 - __v267;
        let __v269 = __links[2][4] * __v268;
        let __v270 = __v265 + __v269;
        let __v271 = __v261 + __v270;
        let __v272 = __v10 * __v271;
        let __v273 = __links[2][6] * __v260;
        let __v274 = __links[2][0] * __v264;
        let __v275 = __links[2][3] * __v268;
        let __v276 = __v274 + __v275;
        let __v277 = __v273 + __v276;
        let __v278 = __v15 * __v277;
        let __v279 = __v272 - __v278;
        let __v280 = __sin_cos[2][1] * __v271;
        let __v281 = __sin_cos[2][0] * __v277;
        let __v282 = __v280 - __v281;
        let __v283 = __v2 * __v282;
        let __v284 = __links[2][8] * __v260;
        let __v285 = __links[2][2] * __v264;
        let __v286 = __links[2][5] * __v268;
        let __v287 = __v285 + __v286;
        let __v288 = __v284 + __v287;
        let __v289 = __v7 * __v288;
        let __v290 = __v283 - __v289;
        [
            __v95,
            __v101,
            __v120,
            __v131,
            __v153,
            __v164,
            __v186,
            __v197,
            __v213,
            __v224,
            __v246,
            __v257,
            __v279,
            __v290,
        ]
    }
};

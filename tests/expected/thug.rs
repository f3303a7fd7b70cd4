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
        let __v5 = __target[1] * __sin_cos[3];
        let __v8 = __target[2] * __sin_cos[2];
        let __v9 = __v5 + __v8;
        let __v10 = __sin_cos[0] * __v9;
        let __v13 = __target[0] * __sin_cos[1];
        let __v14 = __v10 - __v13;
        let __v15 = __effector_to_joint[9] + __v14;
        let __v16 = __v15 * __v15;
        let __v18 = __sin_cos[1] * __v9;
        let __v19 = __target[0] * __sin_cos[0];
        let __v20 = __v18 + __v19;
        let __v21 = __effector_to_joint[10] - __v20;
        let __v22 = __v21 * __v21;
        let __v24 = __target[1] * __sin_cos[2];
        let __v25 = __target[2] * __sin_cos[3];
        let __v26 = __v24 - __v25;
        let __v27 = __effector_to_joint[11] + __v26;
        let __v28 = __v27 * __v27;
        let __v29 = __v22 + __v28;
        let __v30 = __v16 + __v29;
        let __v31 = <S as ::aim::__private::Scalar>::sqrt(__v30);
        let __v33 = <S as ::aim::__private::Scalar>::constant(1.0) / __v31;
        let __v35 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v31,
            __v33,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v37 = __effector_to_joint[3] * __v15;
        let __v39 = __effector_to_joint[4] * __v21;
        let __v41 = __effector_to_joint[5] * __v27;
        let __v42 = __v39 + __v41;
        let __v43 = __v37 + __v42;
        let __v44 = __v35 * __v43;
        let __v46 = __v35 * __v44;
        let __v47 = __v21 * __v46;
        let __v48 = __effector_to_joint[4] - __v47;
        let __v49 = __v14 * __v48;
        let __v50 = __v15 * __v46;
        let __v51 = __effector_to_joint[3] - __v50;
        let __v52 = __v20 * __v51;
        let __v53 = __v49 + __v52;
        let __v54 = __v35 * __v53;
        let __v56 = __sin_cos[1] * __v48;
        let __v57 = __sin_cos[0] * __v51;
        let __v58 = __v56 - __v57;
        let __v59 = __v26 * __v58;
        let __v60 = __v27 * __v46;
        let __v61 = __effector_to_joint[5] - __v60;
        let __v62 = __v9 * __v61;
        let __v63 = __v59 + __v62;
        let __v64 = __v35 * __v63;
        [-__v44, -__v54, -__v64]
    }
    ///The chain's aim, then its derivatives. 173 operations: 67 add, 104 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Thug`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 3],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 3],
    ) -> [S; 7] {
        let __v11 = __target[1] * __sin_cos[2][2];
        let __v14 = __target[2] * __sin_cos[2][3];
        let __v15 = __v11 - __v14;
        let __v16 = __links[2][11] + __v15;
        let __v17 = __links[2][5] * __v16;
        let __v21 = __target[1] * __sin_cos[2][3];
        let __v22 = __target[2] * __sin_cos[2][2];
        let __v23 = __v21 + __v22;
        let __v24 = __sin_cos[2][0] * __v23;
        let __v27 = __target[0] * __sin_cos[2][1];
        let __v28 = __v24 - __v27;
        let __v29 = __links[2][9] + __v28;
        let __v30 = __links[2][3] * __v29;
        let __v33 = __sin_cos[2][1] * __v23;
        let __v34 = __target[0] * __sin_cos[2][0];
        let __v35 = __v33 + __v34;
        let __v36 = __links[2][10] - __v35;
        let __v37 = __links[2][4] * __v36;
        let __v38 = __v30 + __v37;
        let __v39 = __v17 + __v38;
        let __v40 = __sin_cos[1][2] * __v39;
        let __v43 = __links[2][8] * __v16;
        let __v45 = __links[2][6] * __v29;
        let __v47 = __links[2][7] * __v36;
        let __v48 = __v45 + __v47;
        let __v49 = __v43 + __v48;
        let __v50 = __sin_cos[1][3] * __v49;
        let __v51 = __v40 - __v50;
        let __v52 = __links[1][11] - __v51;
        let __v53 = __links[1][5] * __v52;
        let __v57 = __sin_cos[1][3] * __v39;
        let __v58 = __sin_cos[1][2] * __v49;
        let __v59 = __v57 + __v58;
        let __v60 = __sin_cos[1][0] * __v59;
        let __v63 = __links[2][2] * __v16;
        let __v65 = __links[2][0] * __v29;
        let __v67 = __links[2][1] * __v36;
        let __v68 = __v65 + __v67;
        let __v69 = __v63 + __v68;
        let __v70 = __sin_cos[1][1] * __v69;
        let __v71 = __v60 - __v70;
        let __v72 = __links[1][9] - __v71;
        let __v73 = __links[1][3] * __v72;
        let __v76 = __sin_cos[1][1] * __v59;
        let __v77 = __sin_cos[1][0] * __v69;
        let __v78 = __v76 + __v77;
        let __v79 = __links[1][10] + __v78;
        let __v80 = __links[1][4] * __v79;
        let __v81 = __v73 + __v80;
        let __v82 = __v53 + __v81;
        let __v83 = __sin_cos[0][3] * __v82;
        let __v86 = __links[1][8] * __v52;
        let __v88 = __links[1][6] * __v72;
        let __v90 = __links[1][7] * __v79;
        let __v91 = __v88 + __v90;
        let __v92 = __v86 + __v91;
        let __v93 = __sin_cos[0][2] * __v92;
        let __v94 = __v83 + __v93;
        let __v95 = __sin_cos[0][0] * __v94;
        let __v98 = __links[1][2] * __v52;
        let __v100 = __links[1][0] * __v72;
        let __v102 = __links[1][1] * __v79;
        let __v103 = __v100 + __v102;
        let __v104 = __v98 + __v103;
        let __v105 = __sin_cos[0][1] * __v104;
        let __v106 = __v95 - __v105;
        let __v107 = __links[0][9] - __v106;
        let __v108 = __v107 * __v107;
        let __v110 = __sin_cos[0][1] * __v94;
        let __v111 = __sin_cos[0][0] * __v104;
        let __v112 = __v110 + __v111;
        let __v113 = __links[0][10] + __v112;
        let __v114 = __v113 * __v113;
        let __v116 = __sin_cos[0][2] * __v82;
        let __v117 = __sin_cos[0][3] * __v92;
        let __v118 = __v116 - __v117;
        let __v119 = __links[0][11] - __v118;
        let __v120 = __v119 * __v119;
        let __v121 = __v114 + __v120;
        let __v122 = __v108 + __v121;
        let __v123 = <S as ::aim::__private::Scalar>::sqrt(__v122);
        let __v125 = <S as ::aim::__private::Scalar>::constant(1.0) / __v123;
        let __v127 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v123,
            __v125,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v129 = __links[0][3] * __v107;
        let __v131 = __links[0][4] * __v113;
        let __v133 = __links[0][5] * __v119;
        let __v134 = __v131 + __v133;
        let __v135 = __v129 + __v134;
        let __v136 = __v127 * __v135;
        let __v138 = __v127 * __v136;
        let __v139 = __v113 * __v138;
        let __v140 = __links[0][4] - __v139;
        let __v141 = __v127 * __v140;
        let __v142 = __v106 * __v141;
        let __v143 = __v107 * __v138;
        let __v144 = __links[0][3] - __v143;
        let __v145 = __v127 * __v144;
        let __v146 = __v112 * __v145;
        let __v147 = __v142 + __v146;
        let __v148 = __sin_cos[0][1] * __v141;
        let __v149 = __sin_cos[0][0] * __v145;
        let __v150 = __v148 - __v149;
        let __v151 = __v118 * __v150;
        let __v152 = __v119 * __v138;
        let __v153 = __links[0][5] - __v152;
        let __v154 = __v127 * __v153;
        let __v155 = __v94 * __v154;
        let __v156 = __v151 + __v155;
        let __v157 = __sin_cos[0][2] * __v150;
        let __v158 = __sin_cos[0][3] * __v154;
        let __v159 = __v157 + __v158;
        let __v160 = __links[1][7] * __v159;
        let __v161 = __sin_cos[0][0] * __v141;
        let __v162 = __sin_cos[0][1] * __v145;
        let __v163 = __v161 + __v162;
        let __v164 = __links[1][1] * __v163;
        let __v165 = __sin_cos[0][3] * __v150;
        let __v166 = __sin_cos[0][2] * __v154;
        let __v167 = __v165 - __v166;
        let __v168 = __links[1][4] * __v167;
        let __v169 = __v164 + __v168;
        let __v170 = __v160 + __v169;
        let __v171 = __v71 * __v170;
        let __v172 = __links[1][6] * __v159;
        let __v173 = __links[1][0] * __v163;
        let __v174 = __links[1][3] * __v167;
        let __v175 = __v173 + __v174;
        let __v176 = __v172 + __v175;
        let __v177 = __v78 * __v176;
        let __v178 = __v171 + __v177;
        let __v179 = __sin_cos[1][1] * __v170;
        let __v180 = __sin_cos[1][0] * __v176;
        let __v181 = __v179 - __v180;
        let __v182 = __v51 * __v181;
        let __v183 = __links[1][8] * __v159;
        let __v184 = __links[1][2] * __v163;
        let __v185 = __links[1][5] * __v167;
        let __v186 = __v184 + __v185;
        let __v187 = __v183 + __v186;
        let __v188 = __v59 * __v187;
        let __v189 = __v182 + __v188;
        let __v190 = __sin_cos[1][2] * __v181;
        let __v191 = __sin_cos[1][3] * __v187;
        let __v192 = __v190 + __v191;
        let __v193 = __links[2][7] * __v192;
        let __v194 = __sin_cos[1][0] * __v170;
        let __v195 = __sin_cos[1][1] * __v176;
        let __v196 = __v194 + __v195;
        let __v197 = __links[2][1] * __v196;
        let __v198 = __sin_cos[1][3] * __v181;
        let __v199 = __sin_cos[1][2] * __v187;
        let __v200 = __v198 - __v199;
        let __v201 = __links[2][4] * __v200;
        let __v202 = __v197 + __v201;
        let __v203 = __v193 + __v202;
        let __v204 = __v28 * __v203;
        let __v205 = __links[2][6] * __v192;
        let __v206 = __links[2][0] * __v196;
        let __v207 = __links[2][3] * __v200;
        let __v208 = __v206 + __v207;
        let __v209 = __v205 + __v208;
        let __v210 = __v35 * __v209;
        let __v211 = __v204 + __v210;
        let __v213 = __sin_cos[2][1] * __v203;
        let __v214 = __sin_cos[2][0] * __v209;
        let __v215 = __v213 - __v214;
        let __v216 = __v15 * __v215;
        let __v217 = __links[2][8] * __v192;
        let __v218 = __links[2][2] * __v196;
        let __v219 = __links[2][5] * __v200;
        let __v220 = __v218 + __v219;
        let __v221 = __v217 + __v220;
        let __v222 = __v23 * __v221;
        let __v223 = __v216 + __v222;
        [-__v136, __v147, __v156, __v178, __v189, -__v211, -__v223]
    }
    ///The chain's residual (left, up), then the derivatives of each. 289 operations: 108 add, 178 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Thug`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 3],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 3],
    ) -> [S; 14] {
        let __v12 = __target[1] * __sin_cos[2][2];
        let __v15 = __target[2] * __sin_cos[2][3];
        let __v16 = __v12 - __v15;
        let __v17 = __links[2][11] + __v16;
        let __v18 = __links[2][5] * __v17;
        let __v22 = __target[1] * __sin_cos[2][3];
        let __v23 = __target[2] * __sin_cos[2][2];
        let __v24 = __v22 + __v23;
        let __v25 = __sin_cos[2][0] * __v24;
        let __v28 = __target[0] * __sin_cos[2][1];
        let __v29 = __v25 - __v28;
        let __v30 = __links[2][9] + __v29;
        let __v31 = __links[2][3] * __v30;
        let __v34 = __sin_cos[2][1] * __v24;
        let __v35 = __target[0] * __sin_cos[2][0];
        let __v36 = __v34 + __v35;
        let __v37 = __links[2][10] - __v36;
        let __v38 = __links[2][4] * __v37;
        let __v39 = __v31 + __v38;
        let __v40 = __v18 + __v39;
        let __v41 = __sin_cos[1][2] * __v40;
        let __v44 = __links[2][8] * __v17;
        let __v46 = __links[2][6] * __v30;
        let __v48 = __links[2][7] * __v37;
        let __v49 = __v46 + __v48;
        let __v50 = __v44 + __v49;
        let __v51 = __sin_cos[1][3] * __v50;
        let __v52 = __v41 - __v51;
        let __v53 = __links[1][11] - __v52;
        let __v54 = __links[1][5] * __v53;
        let __v58 = __sin_cos[1][3] * __v40;
        let __v59 = __sin_cos[1][2] * __v50;
        let __v60 = __v58 + __v59;
        let __v61 = __sin_cos[1][0] * __v60;
        let __v64 = __links[2][2] * __v17;
        let __v66 = __links[2][0] * __v30;
        let __v68 = __links[2][1] * __v37;
        let __v69 = __v66 + __v68;
        let __v70 = __v64 + __v69;
        let __v71 = __sin_cos[1][1] * __v70;
        let __v72 = __v61 - __v71;
        let __v73 = __links[1][9] - __v72;
        let __v74 = __links[1][3] * __v73;
        let __v77 = __sin_cos[1][1] * __v60;
        let __v78 = __sin_cos[1][0] * __v70;
        let __v79 = __v77 + __v78;
        let __v80 = __links[1][10] + __v79;
        let __v81 = __links[1][4] * __v80;
        let __v82 = __v74 + __v81;
        let __v83 = __v54 + __v82;
        let __v84 = __sin_cos[0][3] * __v83;
        let __v87 = __links[1][8] * __v53;
        let __v89 = __links[1][6] * __v73;
        let __v91 = __links[1][7] * __v80;
        let __v92 = __v89 + __v91;
        let __v93 = __v87 + __v92;
        let __v94 = __sin_cos[0][2] * __v93;
        let __v95 = __v84 + __v94;
        let __v96 = __sin_cos[0][0] * __v95;
        let __v99 = __links[1][2] * __v53;
        let __v101 = __links[1][0] * __v73;
        let __v103 = __links[1][1] * __v80;
        let __v104 = __v101 + __v103;
        let __v105 = __v99 + __v104;
        let __v106 = __sin_cos[0][1] * __v105;
        let __v107 = __v96 - __v106;
        let __v108 = __links[0][9] - __v107;
        let __v109 = __v108 * __v108;
        let __v111 = __sin_cos[0][1] * __v95;
        let __v112 = __sin_cos[0][0] * __v105;
        let __v113 = __v111 + __v112;
        let __v114 = __links[0][10] + __v113;
        let __v115 = __v114 * __v114;
        let __v117 = __sin_cos[0][2] * __v83;
        let __v118 = __sin_cos[0][3] * __v93;
        let __v119 = __v117 - __v118;
        let __v120 = __links[0][11] - __v119;
        let __v121 = __v120 * __v120;
        let __v122 = __v115 + __v121;
        let __v123 = __v109 + __v122;
        let __v124 = <S as ::aim::__private::Scalar>::sqrt(__v123);
        let __v126 = __links[0][5] * __v120;
        let __v128 = __links[0][3] * __v108;
        let __v130 = __links[0][4] * __v114;
        let __v131 = __v128 + __v130;
        let __v132 = __v126 + __v131;
        let __v133 = __v124 - __v132;
        let __v135 = <S as ::aim::__private::Scalar>::constant(1.0) / __v133;
        let __v137 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v133,
            __v135,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v138 = <S as ::aim::__private::Scalar>::constant(2.0) * __v137;
        let __v140 = __links[0][8] * __v120;
        let __v142 = __links[0][6] * __v108;
        let __v144 = __links[0][7] * __v114;
        let __v145 = __v142 + __v144;
        let __v146 = __v140 + __v145;
        let __v147 = __v138 * __v146;
        let __v150 = __links[0][2] * __v120;
        let __v152 = __links[0][0] * __v108;
        let __v154 = __links[0][1] * __v114;
        let __v155 = __v152 + __v154;
        let __v156 = __v150 + __v155;
        let __v157 = __v138 * __v156;
        let __v159 = __links[0][7] * __v138;
        let __v160 = <S as ::aim::__private::Scalar>::constant(2.0) * __v146;
        let __v161 = __v137 * __v137;
        let __v162 = __v160 * __v161;
        let __v163 = __links[0][4] * __v162;
        let __v164 = __v159 + __v163;
        let __v165 = <S as ::aim::__private::Scalar>::constant(1.0) / __v124;
        let __v166 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v124,
            __v165,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v167 = __v162 * __v166;
        let __v168 = __v114 * __v167;
        let __v169 = __v164 - __v168;
        let __v170 = __v107 * __v169;
        let __v171 = __links[0][6] * __v138;
        let __v172 = __links[0][3] * __v162;
        let __v173 = __v171 + __v172;
        let __v174 = __v108 * __v167;
        let __v175 = __v173 - __v174;
        let __v176 = __v113 * __v175;
        let __v177 = __v170 + __v176;
        let __v178 = __sin_cos[0][1] * __v169;
        let __v179 = __sin_cos[0][0] * __v175;
        let __v180 = __v178 - __v179;
        let __v181 = __v119 * __v180;
        let __v182 = __links[0][8] * __v138;
        let __v183 = __links[0][5] * __v162;
        let __v184 = __v182 + __v183;
        let __v185 = __v120 * __v167;
        let __v186 = __v184 - __v185;
        let __v187 = __v95 * __v186;
        let __v188 = __v181 + __v187;
        let __v189 = __sin_cos[0][2] * __v180;
        let __v190 = __sin_cos[0][3] * __v186;
        let __v191 = __v189 + __v190;
        let __v192 = __links[1][7] * __v191;
        let __v193 = __sin_cos[0][0] * __v169;
        let __v194 = __sin_cos[0][1] * __v175;
        let __v195 = __v193 + __v194;
        let __v196 = __links[1][1] * __v195;
        let __v197 = __sin_cos[0][3] * __v180;
        let __v198 = __sin_cos[0][2] * __v186;
        let __v199 = __v197 - __v198;
        let __v200 = __links[1][4] * __v199;
        let __v201 = __v196 + __v200;
        let __v202 = __v192 + __v201;
        let __v203 = __v72 * __v202;
        let __v204 = __links[1][6] * __v191;
        let __v205 = __links[1][0] * __v195;
        let __v206 = __links[1][3] * __v199;
        let __v207 = __v205 + __v206;
        let __v208 = __v204 + __v207;
        let __v209 = __v79 * __v208;
        let __v210 = __v203 + __v209;
        let __v211 = __sin_cos[1][1] * __v202;
        let __v212 = __sin_cos[1][0] * __v208;
        let __v213 = __v211 - __v212;
        let __v214 = __v52 * __v213;
        let __v215 = __links[1][8] * __v191;
        let __v216 = __links[1][2] * __v195;
        let __v217 = __links[1][5] * __v199;
        let __v218 = __v216 + __v217;
        let __v219 = __v215 + __v218;
        let __v220 = __v60 * __v219;
        let __v221 = __v214 + __v220;
        let __v222 = __sin_cos[1][2] * __v213;
        let __v223 = __sin_cos[1][3] * __v219;
        let __v224 = __v222 + __v223;
        let __v225 = __links[2][7] * __v224;
        let __v226 = __sin_cos[1][0] * __v202;
        let __v227 = __sin_cos[1][1] * __v208;
        let __v228 = __v226 + __v227;
        let __v229 = __links[2][1] * __v228;
        let __v230 = __sin_cos[1][3] * __v213;
        let __v231 = __sin_cos[1][2] * __v219;
        let __v232 = __v230 - __v231;
        let __v233 = __links[2][4] * __v232;
        let __v234 = __v229 + __v233;
        let __v235 = __v225 + __v234;
        let __v236 = __v29 * __v235;
        let __v237 = __links[2][6] * __v224;
        let __v238 = __links[2][0] * __v228;
        let __v239 = __links[2][3] * __v232;
        let __v240 = __v238 + __v239;
        let __v241 = __v237 + __v240;
        let __v242 = __v36 * __v241;
        let __v243 = __v236 + __v242;
        let __v245 = __sin_cos[2][1] * __v235;
        let __v246 = __sin_cos[2][0] * __v241;
        let __v247 = __v245 - __v246;
        let __v248 = __v16 * __v247;
        let __v249 = __links[2][8] * __v224;
        let __v250 = __links[2][2] * __v228;
        let __v251 = __links[2][5] * __v232;
        let __v252 = __v250 + __v251;
        let __v253 = __v249 + __v252;
        let __v254 = __v24 * __v253;
        let __v255 = __v248 + __v254;
        let __v257 = __links[0][1] * __v138;
        let __v258 = <S as ::aim::__private::Scalar>::constant(2.0) * __v156;
        let __v259 = __v161 * __v258;
        let __v260 = __links[0][4] * __v259;
        let __v261 = __v257 + __v260;
        let __v262 = __v166 * __v259;
        let __v263 = __v114 * __v262;
        let __v264 = __v261 - __v263;
        let __v265 = __v107 * __v264;
        let __v266 = __links[0][0] * __v138;
        let __v267 = __links[0][3] * __v259;
        let __v268 = __v266 + __v267;
        let __v269 = __v108 * __v262;
        let __v270 = __v268 - __v269;
        let __v271 = __v113 * __v270;
        let __v272 = __v265 + __v271;
        let __v273 = __sin_cos[0][1] * __v264;
        let __v274 = __sin_cos[0][0] * __v270;
        let __v275 = __v273 - __v274;
        let __v276 = __v119 * __v275;
        let __v277 = __links[0][2] * __v138;
        let __v278 = __links[0][5] * __v259;
        let __v279 = __v277 + __v278;
        let __v280 = __v120 * __v262;
        let __v281 = __v279 - __v280;
        let __v282 = __v95 * __v281;
        let __v283 = __v276 + __v282;
        let __v284 = __sin_cos[0][2] * __v275;
        let __v285 = __sin_cos[0][3] * __v281;
        let __v286 = __v284 + __v285;
        let __v287 = __links[1][7] * __v286;
        let __v288 = __sin_cos[0][0] * __v264;
        let __v289 = __sin_cos[0][1] * __v270;
        let __v290 = __v288 + __v289;
        let __v291 = __links[1][1] * __v290;
        let __v292 = __sin_cos[0][3] * __v275;
        let __v293 = __sin_cos[0][2] * __v281;
        let __v294 = __v292 - __v293;
        let __v295 = __links[1][4] * __v294;
        let __v296 = __v291 + __v295;
        let __v297 = __v287 + __v296;
        let __v298 = __v72 * __v297;
        let __v299 = __links[1][6] * __v286;
        let __v300 = __links[1][0] * __v290;
        let __v301 = __links[1][3] * __v294;
        let __v302 = __v300 + __v301;
        let __v303 = __v299 + __v302;
        let __v304 = __v79 * __v303;
        let __v305 = __v298 + __v304;
        let __v306 = __sin_cos[1][1] * __v297;
        let __v307 = __sin_cos[1][0] * __v303;
        let __v308 = __v306 - __v307;
        let __v309 = __v52 * __v308;
        let __v310 = __links[1][8] * __v286;
        let __v311 = __links[1][2] * __v290;
        let __v312 = __links[1][5] * __v294;
        let __v313 = __v311 + __v312;
        let __v314 = __v310 + __v313;
        let __v315 = __v60 * __v314;
        let __v316 = __v309 + __v315;
        let __v317 = __sin_cos[1][2] * __v308;
        let __v318 = __sin_cos[1][3] * __v314;
        let __v319 = __v317 + __v318;
        let __v320 = __links[2][7] * __v319;
        let __v321 = __sin_cos[1][0] * __v297;
        let __v322 = __sin_cos[1][1] * __v303;
        let __v323 = __v321 + __v322;
        let __v324 = __links[2][1] * __v323;
        let __v325 = __sin_cos[1][3] * __v308;
        let __v326 = __sin_cos[1][2] * __v314;
        let __v327 = __v325 - __v326;
        let __v328 = __links[2][4] * __v327;
        let __v329 = __v324 + __v328;
        let __v330 = __v320 + __v329;
        let __v331 = __v29 * __v330;
        let __v332 = __links[2][6] * __v319;
        let __v333 = __links[2][0] * __v323;
        let __v334 = __links[2][3] * __v327;
        let __v335 = __v333 + __v334;
        let __v336 = __v332 + __v335;
        let __v337 = __v36 * __v336;
        let __v338 = __v331 + __v337;
        let __v340 = __sin_cos[2][1] * __v330;
        let __v341 = __sin_cos[2][0] * __v336;
        let __v342 = __v340 - __v341;
        let __v343 = __v16 * __v342;
        let __v344 = __links[2][8] * __v319;
        let __v345 = __links[2][2] * __v323;
        let __v346 = __links[2][5] * __v327;
        let __v347 = __v345 + __v346;
        let __v348 = __v344 + __v347;
        let __v349 = __v24 * __v348;
        let __v350 = __v343 + __v349;
        [
            -__v147,
            -__v157,
            __v177,
            __v188,
            __v210,
            __v221,
            -__v243,
            -__v255,
            __v272,
            __v283,
            __v305,
            __v316,
            -__v338,
            -__v350,
        ]
    }
};

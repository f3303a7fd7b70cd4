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
        let __v5 = __target[1] * __sin_cos[3];
        let __v8 = __target[2] * __sin_cos[2];
        let __v9 = __v5 - __v8;
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
        let __v26 = __v24 + __v25;
        let __v27 = __effector_to_joint[11] - __v26;
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
        let __v63 = __v59 - __v62;
        let __v64 = __v35 * __v63;
        [-__v44, -__v54, -__v64]
    }
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `head`. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `LeftHanded`.
    #[inline]
    fn aim_gradient_1<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v5 = __target[0] * __sin_cos[3];
        let __v8 = __target[1] * __sin_cos[2];
        let __v9 = __v5 + __v8;
        let __v10 = __sin_cos[0] * __v9;
        let __v13 = __target[2] * __sin_cos[1];
        let __v14 = __v10 - __v13;
        let __v15 = __effector_to_joint[11] + __v14;
        let __v16 = __v15 * __v15;
        let __v18 = __sin_cos[1] * __v9;
        let __v19 = __target[2] * __sin_cos[0];
        let __v20 = __v18 + __v19;
        let __v21 = __effector_to_joint[9] - __v20;
        let __v22 = __v21 * __v21;
        let __v24 = __target[0] * __sin_cos[2];
        let __v25 = __target[1] * __sin_cos[3];
        let __v26 = __v24 - __v25;
        let __v27 = __effector_to_joint[10] + __v26;
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
        let __v37 = __effector_to_joint[5] * __v15;
        let __v39 = __effector_to_joint[3] * __v21;
        let __v41 = __effector_to_joint[4] * __v27;
        let __v42 = __v39 + __v41;
        let __v43 = __v37 + __v42;
        let __v44 = __v35 * __v43;
        let __v46 = __v35 * __v44;
        let __v47 = __v21 * __v46;
        let __v48 = __effector_to_joint[3] - __v47;
        let __v49 = __v14 * __v48;
        let __v50 = __v15 * __v46;
        let __v51 = __effector_to_joint[5] - __v50;
        let __v52 = __v20 * __v51;
        let __v53 = __v49 + __v52;
        let __v54 = __v35 * __v53;
        let __v56 = __sin_cos[1] * __v48;
        let __v57 = __sin_cos[0] * __v51;
        let __v58 = __v56 - __v57;
        let __v59 = __v26 * __v58;
        let __v60 = __v27 * __v46;
        let __v61 = __effector_to_joint[4] - __v60;
        let __v62 = __v9 * __v61;
        let __v63 = __v59 + __v62;
        let __v64 = __v35 * __v63;
        [-__v44, -__v54, -__v64]
    }
    ///The chain's aim, then its derivatives. 110 operations: 42 add, 66 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `LeftHanded`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 5] {
        let __v9 = __target[0] * __sin_cos[1][3];
        let __v12 = __target[1] * __sin_cos[1][2];
        let __v13 = __v9 + __v12;
        let __v14 = __sin_cos[1][0] * __v13;
        let __v17 = __target[2] * __sin_cos[1][1];
        let __v18 = __v14 - __v17;
        let __v19 = __links[1][11] + __v18;
        let __v20 = __links[1][5] * __v19;
        let __v23 = __sin_cos[1][1] * __v13;
        let __v24 = __target[2] * __sin_cos[1][0];
        let __v25 = __v23 + __v24;
        let __v26 = __links[1][9] - __v25;
        let __v27 = __links[1][3] * __v26;
        let __v30 = __target[0] * __sin_cos[1][2];
        let __v31 = __target[1] * __sin_cos[1][3];
        let __v32 = __v30 - __v31;
        let __v33 = __links[1][10] + __v32;
        let __v34 = __links[1][4] * __v33;
        let __v35 = __v27 + __v34;
        let __v36 = __v20 + __v35;
        let __v37 = __sin_cos[0][3] * __v36;
        let __v40 = __links[1][8] * __v19;
        let __v42 = __links[1][6] * __v26;
        let __v44 = __links[1][7] * __v33;
        let __v45 = __v42 + __v44;
        let __v46 = __v40 + __v45;
        let __v47 = __sin_cos[0][2] * __v46;
        let __v48 = __v37 - __v47;
        let __v49 = __sin_cos[0][0] * __v48;
        let __v52 = __links[1][2] * __v19;
        let __v54 = __links[1][0] * __v26;
        let __v56 = __links[1][1] * __v33;
        let __v57 = __v54 + __v56;
        let __v58 = __v52 + __v57;
        let __v59 = __sin_cos[0][1] * __v58;
        let __v60 = __v49 - __v59;
        let __v61 = __links[0][9] - __v60;
        let __v62 = __v61 * __v61;
        let __v64 = __sin_cos[0][1] * __v48;
        let __v65 = __sin_cos[0][0] * __v58;
        let __v66 = __v64 + __v65;
        let __v67 = __links[0][10] + __v66;
        let __v68 = __v67 * __v67;
        let __v70 = __sin_cos[0][2] * __v36;
        let __v71 = __sin_cos[0][3] * __v46;
        let __v72 = __v70 + __v71;
        let __v73 = __links[0][11] + __v72;
        let __v74 = __v73 * __v73;
        let __v75 = __v68 + __v74;
        let __v76 = __v62 + __v75;
        let __v77 = <S as ::aim::__private::Scalar>::sqrt(__v76);
        let __v79 = <S as ::aim::__private::Scalar>::constant(1.0) / __v77;
        let __v81 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v77,
            __v79,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v83 = __links[0][3] * __v61;
        let __v85 = __links[0][4] * __v67;
        let __v87 = __links[0][5] * __v73;
        let __v88 = __v85 + __v87;
        let __v89 = __v83 + __v88;
        let __v90 = __v81 * __v89;
        let __v92 = __v81 * __v90;
        let __v93 = __v67 * __v92;
        let __v94 = __links[0][4] - __v93;
        let __v95 = __v81 * __v94;
        let __v96 = __v60 * __v95;
        let __v97 = __v61 * __v92;
        let __v98 = __links[0][3] - __v97;
        let __v99 = __v81 * __v98;
        let __v100 = __v66 * __v99;
        let __v101 = __v96 + __v100;
        let __v102 = __sin_cos[0][1] * __v95;
        let __v103 = __sin_cos[0][0] * __v99;
        let __v104 = __v102 - __v103;
        let __v105 = __v72 * __v104;
        let __v106 = __v73 * __v92;
        let __v107 = __links[0][5] - __v106;
        let __v108 = __v81 * __v107;
        let __v109 = __v48 * __v108;
        let __v110 = __v105 - __v109;
        let __v111 = __sin_cos[0][2] * __v104;
        let __v112 = __sin_cos[0][3] * __v108;
        let __v113 = __v111 - __v112;
        let __v114 = __links[1][6] * __v113;
        let __v115 = __sin_cos[0][0] * __v95;
        let __v116 = __sin_cos[0][1] * __v99;
        let __v117 = __v115 + __v116;
        let __v118 = __links[1][0] * __v117;
        let __v119 = __sin_cos[0][3] * __v104;
        let __v120 = __sin_cos[0][2] * __v108;
        let __v121 = __v119 + __v120;
        let __v122 = __links[1][3] * __v121;
        let __v123 = __v118 + __v122;
        let __v124 = __v114 - __v123;
        let __v125 = __v18 * __v124;
        let __v126 = __links[1][8] * __v113;
        let __v127 = __links[1][2] * __v117;
        let __v128 = __links[1][5] * __v121;
        let __v129 = __v127 + __v128;
        let __v130 = __v126 - __v129;
        let __v131 = __v25 * __v130;
        let __v132 = __v125 + __v131;
        let __v133 = __sin_cos[1][1] * __v124;
        let __v134 = __sin_cos[1][0] * __v130;
        let __v135 = __v133 - __v134;
        let __v136 = __v32 * __v135;
        let __v137 = __links[1][7] * __v113;
        let __v138 = __links[1][1] * __v117;
        let __v139 = __links[1][4] * __v121;
        let __v140 = __v138 + __v139;
        let __v141 = __v137 - __v140;
        let __v142 = __v13 * __v141;
        let __v143 = __v136 + __v142;
        [-__v90, __v101, __v110, __v132, __v143]
    }
    ///The chain's residual (left, up), then the derivatives of each. 193 operations: 71 add, 119 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `LeftHanded`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 10] {
        let __v10 = __target[0] * __sin_cos[1][3];
        let __v13 = __target[1] * __sin_cos[1][2];
        let __v14 = __v10 + __v13;
        let __v15 = __sin_cos[1][0] * __v14;
        let __v18 = __target[2] * __sin_cos[1][1];
        let __v19 = __v15 - __v18;
        let __v20 = __links[1][11] + __v19;
        let __v21 = __links[1][5] * __v20;
        let __v24 = __sin_cos[1][1] * __v14;
        let __v25 = __target[2] * __sin_cos[1][0];
        let __v26 = __v24 + __v25;
        let __v27 = __links[1][9] - __v26;
        let __v28 = __links[1][3] * __v27;
        let __v31 = __target[0] * __sin_cos[1][2];
        let __v32 = __target[1] * __sin_cos[1][3];
        let __v33 = __v31 - __v32;
        let __v34 = __links[1][10] + __v33;
        let __v35 = __links[1][4] * __v34;
        let __v36 = __v28 + __v35;
        let __v37 = __v21 + __v36;
        let __v38 = __sin_cos[0][3] * __v37;
        let __v41 = __links[1][8] * __v20;
        let __v43 = __links[1][6] * __v27;
        let __v45 = __links[1][7] * __v34;
        let __v46 = __v43 + __v45;
        let __v47 = __v41 + __v46;
        let __v48 = __sin_cos[0][2] * __v47;
        let __v49 = __v38 - __v48;
        let __v50 = __sin_cos[0][0] * __v49;
        let __v53 = __links[1][2] * __v20;
        let __v55 = __links[1][0] * __v27;
        let __v57 = __links[1][1] * __v34;
        let __v58 = __v55 + __v57;
        let __v59 = __v53 + __v58;
        let __v60 = __sin_cos[0][1] * __v59;
        let __v61 = __v50 - __v60;
        let __v62 = __links[0][9] - __v61;
        let __v63 = __v62 * __v62;
        let __v65 = __sin_cos[0][1] * __v49;
        let __v66 = __sin_cos[0][0] * __v59;
        let __v67 = __v65 + __v66;
        let __v68 = __links[0][10] + __v67;
        let __v69 = __v68 * __v68;
        let __v71 = __sin_cos[0][2] * __v37;
        let __v72 = __sin_cos[0][3] * __v47;
        let __v73 = __v71 + __v72;
        let __v74 = __links[0][11] + __v73;
        let __v75 = __v74 * __v74;
        let __v76 = __v69 + __v75;
        let __v77 = __v63 + __v76;
        let __v78 = <S as ::aim::__private::Scalar>::sqrt(__v77);
        let __v80 = __links[0][5] * __v74;
        let __v82 = __links[0][3] * __v62;
        let __v84 = __links[0][4] * __v68;
        let __v85 = __v82 + __v84;
        let __v86 = __v80 + __v85;
        let __v87 = __v78 - __v86;
        let __v89 = <S as ::aim::__private::Scalar>::constant(1.0) / __v87;
        let __v91 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v87,
            __v89,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v92 = <S as ::aim::__private::Scalar>::constant(2.0) * __v91;
        let __v94 = __links[0][8] * __v74;
        let __v96 = __links[0][6] * __v62;
        let __v98 = __links[0][7] * __v68;
        let __v99 = __v96 + __v98;
        let __v100 = __v94 + __v99;
        let __v101 = __v92 * __v100;
        let __v103 = __links[0][2] * __v74;
        let __v105 = __links[0][0] * __v62;
        let __v107 = __links[0][1] * __v68;
        let __v108 = __v105 + __v107;
        let __v109 = __v103 + __v108;
        let __v110 = __v92 * __v109;
        let __v112 = __links[0][7] * __v92;
        let __v113 = <S as ::aim::__private::Scalar>::constant(2.0) * __v100;
        let __v114 = __v91 * __v91;
        let __v115 = __v113 * __v114;
        let __v116 = __links[0][4] * __v115;
        let __v117 = __v112 + __v116;
        let __v118 = <S as ::aim::__private::Scalar>::constant(1.0) / __v78;
        let __v119 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v78,
            __v118,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v120 = __v115 * __v119;
        let __v121 = __v68 * __v120;
        let __v122 = __v117 - __v121;
        let __v123 = __v61 * __v122;
        let __v124 = __links[0][6] * __v92;
        let __v125 = __links[0][3] * __v115;
        let __v126 = __v124 + __v125;
        let __v127 = __v62 * __v120;
        let __v128 = __v126 - __v127;
        let __v129 = __v67 * __v128;
        let __v130 = __v123 + __v129;
        let __v132 = __sin_cos[0][1] * __v122;
        let __v133 = __sin_cos[0][0] * __v128;
        let __v134 = __v132 - __v133;
        let __v135 = __v73 * __v134;
        let __v136 = __links[0][8] * __v92;
        let __v137 = __links[0][5] * __v115;
        let __v138 = __v136 + __v137;
        let __v139 = __v74 * __v120;
        let __v140 = __v138 - __v139;
        let __v141 = __v49 * __v140;
        let __v142 = __v135 - __v141;
        let __v144 = __sin_cos[0][2] * __v134;
        let __v145 = __sin_cos[0][3] * __v140;
        let __v146 = __v144 - __v145;
        let __v147 = __links[1][6] * __v146;
        let __v148 = __sin_cos[0][0] * __v122;
        let __v149 = __sin_cos[0][1] * __v128;
        let __v150 = __v148 + __v149;
        let __v151 = __links[1][0] * __v150;
        let __v152 = __sin_cos[0][3] * __v134;
        let __v153 = __sin_cos[0][2] * __v140;
        let __v154 = __v152 + __v153;
        let __v155 = __links[1][3] * __v154;
        let __v156 = __v151 + __v155;
        let __v157 = __v147 - __v156;
        let __v158 = __v19 * __v157;
        let __v159 = __links[1][8] * __v146;
        let __v160 = __links[1][2] * __v150;
        let __v161 = __links[1][5] * __v154;
        let __v162 = __v160 + __v161;
        let __v163 = __v159 - __v162;
        let __v164 = __v26 * __v163;
        let __v165 = __v158 + __v164;
        let __v167 = __sin_cos[1][1] * __v157;
        let __v168 = __sin_cos[1][0] * __v163;
        let __v169 = __v167 - __v168;
        let __v170 = __v33 * __v169;
        let __v171 = __links[1][7] * __v146;
        let __v172 = __links[1][1] * __v150;
        let __v173 = __links[1][4] * __v154;
        let __v174 = __v172 + __v173;
        let __v175 = __v171 - __v174;
        let __v176 = __v14 * __v175;
        let __v177 = __v170 + __v176;
        let __v179 = __links[0][1] * __v92;
        let __v180 = <S as ::aim::__private::Scalar>::constant(2.0) * __v109;
        let __v181 = __v114 * __v180;
        let __v182 = __links[0][4] * __v181;
        let __v183 = __v179 + __v182;
        let __v184 = __v119 * __v181;
        let __v185 = __v68 * __v184;
        let __v186 = __v183 - __v185;
        let __v187 = __v61 * __v186;
        let __v188 = __links[0][0] * __v92;
        let __v189 = __links[0][3] * __v181;
        let __v190 = __v188 + __v189;
        let __v191 = __v62 * __v184;
        let __v192 = __v190 - __v191;
        let __v193 = __v67 * __v192;
        let __v194 = __v187 + __v193;
        let __v195 = __sin_cos[0][1] * __v186;
        let __v196 = __sin_cos[0][0] * __v192;
        let __v197 = __v195 - __v196;
        let __v198 = __v73 * __v197;
        let __v199 = __links[0][2] * __v92;
        let __v200 = __links[0][5] * __v181;
        let __v201 = __v199 + __v200;
        let __v202 = __v74 * __v184;
        let __v203 = __v201 - __v202;
        let __v204 = __v49 * __v203;
        let __v205 = __v198 - __v204;
        let __v206 = __sin_cos[0][2] * __v197;
        let __v207 = __sin_cos[0][3] * __v203;
        let __v208 = __v206 - __v207;
        let __v209 = __links[1][6] * __v208;
        let __v210 = __sin_cos[0][0] * __v186;
        let __v211 = __sin_cos[0][1] * __v192;
        let __v212 = __v210 + __v211;
        let __v213 = __links[1][0] * __v212;
        let __v214 = __sin_cos[0][3] * __v197;
        let __v215 = __sin_cos[0][2] * __v203;
        let __v216 = __v214 + __v215;
        let __v217 = __links[1][3] * __v216;
        let __v218 = __v213 + __v217;
        let __v219 = __v209 - __v218;
        let __v220 = __v19 * __v219;
        let __v221 = __links[1][8] * __v208;
        let __v222 = __links[1][2] * __v212;
        let __v223 = __links[1][5] * __v216;
        let __v224 = __v222 + __v223;
        let __v225 = __v221 - __v224;
        let __v226 = __v26 * __v225;
        let __v227 = __v220 + __v226;
        let __v228 = __sin_cos[1][1] * __v219;
        let __v229 = __sin_cos[1][0] * __v225;
        let __v230 = __v228 - __v229;
        let __v231 = __v33 * __v230;
        let __v232 = __links[1][7] * __v208;
        let __v233 = __links[1][1] * __v212;
        let __v234 = __links[1][4] * __v216;
        let __v235 = __v233 + __v234;
        let __v236 = __v232 - __v235;
        let __v237 = __v14 * __v236;
        let __v238 = __v231 + __v237;
        [
            __v101,
            -__v110,
            -__v130,
            -__v142,
            -__v165,
            -__v177,
            __v194,
            __v205,
            __v227,
            __v238,
        ]
    }
};

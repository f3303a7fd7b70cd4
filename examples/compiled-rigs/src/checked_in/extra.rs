// The rig Extra, derived and written by aim 0.1.0. Do not edit: generate again.
///The rig `Extra`: its joints, from the effector inward.
pub struct Extra {
    ///Moves the bone `head`.
    pub head: ::aim::Joint,
    ///Moves the bone `neck`.
    pub neck: ::aim::Joint,
}
#[allow(
    clippy::approx_constant,
    clippy::manual_range_patterns,
    clippy::too_many_lines,
    clippy::unreadable_literal,
    reason = "derived code is for machines: its numbers and its length are those of the rig"
)]
const _: () = {
    impl Extra {
        /// The names that each joint's bone may have in a model, from the effector inward.
        #[allow(
            dead_code,
            unreachable_pub,
            reason = "a rig need not be looked up by its bones' names"
        )]
        pub const BONES: [&'static [&'static ::core::primitive::str]; 2] = [
            &["head"],
            &["neck"],
        ];
    }
    #[automatically_derived]
    impl ::core::default::Default for Extra {
        /// At rest: every angle 0.
        fn default() -> Self {
            Self {
                head: ::core::default::Default::default(),
                neck: ::core::default::Default::default(),
            }
        }
    }
    #[automatically_derived]
    impl ::core::fmt::Debug for Extra {
        fn fmt(
            &self,
            __formatter: &mut ::core::fmt::Formatter<'_>,
        ) -> ::core::fmt::Result {
            ::core::fmt::DebugStruct::finish(
                ::core::fmt::DebugStruct::field(
                    ::core::fmt::DebugStruct::field(
                        &mut ::core::fmt::Formatter::debug_struct(__formatter, "Extra"),
                        "head",
                        &self.head,
                    ),
                    "neck",
                    &self.neck,
                ),
            )
        }
    }
    #[automatically_derived]
    impl ::aim::__private::AimRig for Extra {
        type Array<T: ::core::marker::Copy> = [T; 2];
        #[inline]
        fn array<T: ::core::marker::Copy>(&self, __value: T) -> [T; 2] {
            [__value; 2]
        }
        #[inline]
        fn joint_infos(&self) -> &[::aim::__private::JointInfo] {
            const INFOS: [::aim::__private::JointInfo; 2] = [
                ::aim::__private::JointInfo::new(
                        ::aim::__private::Axes {
                            up: [1.0, 0.0, 0.0],
                            forward: [0.0, 1.0, 0.0],
                            left: [0.0, 0.0, 1.0],
                        },
                        3.4906585,
                    )
                    .with_heading(-0.7853982, 0.7853982)
                    .with_pitch(-0.43633232, 0.43633232)
                    .with_comfort(1.0)
                    .with_role(::aim::__private::Role::Head),
                ::aim::__private::JointInfo::new(
                        ::aim::__private::Axes {
                            up: [1.0, 0.0, 0.0],
                            forward: [0.0, 1.0, 0.0],
                            left: [0.0, 0.0, 1.0],
                        },
                        2.9670596,
                    )
                    .with_heading(-0.61086524, 0.61086524)
                    .with_pitch(-0.34906584, 0.34906584)
                    .with_comfort(2.0)
                    .with_role(::aim::__private::Role::Neck),
            ];
            &INFOS
        }
        #[inline]
        fn effector(&self) -> ::aim::__private::Effector {
            ::aim::__private::Effector {
                forward: [0.0, 1.0, 0.0],
                origin: [0.09, 0.09, 0.0],
            }
        }
        #[inline]
        fn joints(&self) -> [::aim::__private::Joint; 2] {
            [self.head, self.neck]
        }
        #[inline]
        fn joint(
            &self,
            __index: ::core::primitive::usize,
        ) -> ::core::option::Option<&::aim::__private::Joint> {
            match __index {
                0 => ::core::option::Option::Some(&self.head),
                1 => ::core::option::Option::Some(&self.neck),
                _ => ::core::option::Option::None,
            }
        }
        #[inline]
        fn joint_mut(
            &mut self,
            __index: ::core::primitive::usize,
        ) -> ::core::option::Option<&mut ::aim::__private::Joint> {
            match __index {
                0 => ::core::option::Option::Some(&mut self.head),
                1 => ::core::option::Option::Some(&mut self.neck),
                _ => ::core::option::Option::None,
            }
        }
        #[inline]
        fn set_joints(&mut self, __states: [::aim::__private::Joint; 2]) {
            [self.head, self.neck] = __states;
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
                0 | 1 => aim_gradient_0(__effector_to_joint, __target, __sin_cos),
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
    ///Aim, ∂aim/∂pitch, ∂aim/∂heading of `head`, `neck`. 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
    #[inline]
    fn aim_gradient_0<S: ::aim::__private::Scalar>(
        __effector_to_joint: &[S; 12],
        __target: &[S; 3],
        __sin_cos: &[S; 4],
    ) -> [S; 3] {
        let __v0 = __target[1] * __sin_cos[3] + __target[2] * __sin_cos[2];
        let __v1 = __target[0] * __sin_cos[1] - __sin_cos[0] * __v0;
        let __v2 = __v1 - __effector_to_joint[9];
        let __v3 = __sin_cos[1] * __v0 + __target[0] * __sin_cos[0];
        let __v4 = __v3 - __effector_to_joint[10];
        let __v5 = __target[2] * __sin_cos[3] - __target[1] * __sin_cos[2];
        let __v6 = __v5 - __effector_to_joint[11];
        let __v7 = __v2 * __v2 + __v4 * __v4 + __v6 * __v6;
        let __v8 = <S as ::aim::__private::Scalar>::sqrt(__v7);
        let __v9 = <S as ::aim::__private::Scalar>::constant(1.0) / __v8;
        let __v10 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v8,
            __v9,
            <S as ::aim::__private::Scalar>::ZERO,
        );
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
    ///The chain's aim, then its derivatives. 110 operations: 42 add, 66 mul, 1 div, 1 sqrt; 2 select. Derived for the rig `Extra`.
    #[inline]
    fn value_gradient<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 5] {
        let __v0 = __target[1] * __sin_cos[1][3] + __target[2] * __sin_cos[1][2];
        let __v1 = __target[0] * __sin_cos[1][1] - __sin_cos[1][0] * __v0;
        let __v2 = __v1 - __links[1][9];
        let __v3 = __sin_cos[1][1] * __v0 + __target[0] * __sin_cos[1][0];
        let __v4 = __v3 - __links[1][10];
        let __v5 = __target[2] * __sin_cos[1][3] - __target[1] * __sin_cos[1][2];
        let __v6 = __v5 - __links[1][11];
        let __v7 = __links[1][3] * __v2 + __links[1][4] * __v4 + __links[1][5] * __v6;
        let __v8 = __links[1][6] * __v2 + __links[1][7] * __v4 + __links[1][8] * __v6;
        let __v9 = __sin_cos[0][3] * __v7 + __sin_cos[0][2] * __v8;
        let __v10 = __links[1][0] * __v2 + __links[1][1] * __v4 + __links[1][2] * __v6;
        let __v11 = __sin_cos[0][1] * __v10 - __sin_cos[0][0] * __v9;
        let __v12 = __v11 - __links[0][9];
        let __v13 = __sin_cos[0][1] * __v9 + __sin_cos[0][0] * __v10;
        let __v14 = __v13 - __links[0][10];
        let __v15 = __sin_cos[0][3] * __v8 - __sin_cos[0][2] * __v7;
        let __v16 = __v15 - __links[0][11];
        let __v17 = __v12 * __v12 + __v14 * __v14 + __v16 * __v16;
        let __v18 = <S as ::aim::__private::Scalar>::sqrt(__v17);
        let __v19 = <S as ::aim::__private::Scalar>::constant(1.0) / __v18;
        let __v20 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v18,
            __v19,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v21 = __v20
            * (__links[0][3] * __v12 + __links[0][4] * __v14 + __links[0][5] * __v16);
        let __v22 = __v20 * __v21;
        let __v23 = __v20 * (__links[0][4] - __v14 * __v22);
        let __v24 = __v20 * (__links[0][3] - __v12 * __v22);
        let __v25 = __v11 * __v23 - __v13 * __v24;
        let __v26 = __sin_cos[0][1] * __v23 - __sin_cos[0][0] * __v24;
        let __v27 = __v20 * (__links[0][5] - __v16 * __v22);
        let __v28 = __v15 * __v26 - __v9 * __v27;
        let __v29 = __sin_cos[0][0] * __v23 + __sin_cos[0][1] * __v24;
        let __v30 = __sin_cos[0][3] * __v26 - __sin_cos[0][2] * __v27;
        let __v31 = __sin_cos[0][2] * __v26 + __sin_cos[0][3] * __v27;
        let __v32 = __links[1][1] * __v29 + __links[1][4] * __v30
            + __links[1][7] * __v31;
        let __v33 = __links[1][0] * __v29 + __links[1][3] * __v30
            + __links[1][6] * __v31;
        let __v34 = __v1 * __v32 - __v3 * __v33;
        let __v35 = __v0
            * (__links[1][2] * __v29 + __links[1][5] * __v30 + __links[1][8] * __v31);
        let __v36 = __v5 * (__sin_cos[1][1] * __v32 - __sin_cos[1][0] * __v33) - __v35;
        [__v21, __v25, __v28, __v34, __v36]
    }
    ///The chain's residual (left, up), then the derivatives of each. 183 operations: 68 add, 112 mul, 2 div, 1 sqrt; 4 select. Derived for the rig `Extra`.
    #[inline]
    fn residual_jacobian<S: ::aim::__private::Scalar>(
        __links: &[[S; 12]; 2],
        __target: &[S; 3],
        __sin_cos: &[[S; 4]; 2],
    ) -> [S; 10] {
        let __v0 = __target[1] * __sin_cos[1][3] + __target[2] * __sin_cos[1][2];
        let __v1 = __target[0] * __sin_cos[1][1] - __sin_cos[1][0] * __v0;
        let __v2 = __v1 - __links[1][9];
        let __v3 = __sin_cos[1][1] * __v0 + __target[0] * __sin_cos[1][0];
        let __v4 = __v3 - __links[1][10];
        let __v5 = __target[2] * __sin_cos[1][3] - __target[1] * __sin_cos[1][2];
        let __v6 = __v5 - __links[1][11];
        let __v7 = __links[1][3] * __v2 + __links[1][4] * __v4 + __links[1][5] * __v6;
        let __v8 = __links[1][6] * __v2 + __links[1][7] * __v4 + __links[1][8] * __v6;
        let __v9 = __sin_cos[0][3] * __v7 + __sin_cos[0][2] * __v8;
        let __v10 = __links[1][0] * __v2 + __links[1][1] * __v4 + __links[1][2] * __v6;
        let __v11 = __sin_cos[0][1] * __v9 + __sin_cos[0][0] * __v10;
        let __v12 = __v11 - __links[0][10];
        let __v13 = __sin_cos[0][3] * __v8 - __sin_cos[0][2] * __v7;
        let __v14 = __v13 - __links[0][11];
        let __v15 = __sin_cos[0][1] * __v10 - __sin_cos[0][0] * __v9;
        let __v16 = __v15 - __links[0][9];
        let __v17 = __v12 * __v12 + __v14 * __v14 + __v16 * __v16;
        let __v18 = <S as ::aim::__private::Scalar>::sqrt(__v17);
        let __v19 = __v18
            + (__links[0][3] * __v16 + __links[0][4] * __v12 + __links[0][5] * __v14);
        let __v20 = <S as ::aim::__private::Scalar>::constant(1.0) / __v19;
        let __v21 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v19,
            __v20,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v22 = <S as ::aim::__private::Scalar>::constant(2.0) * __v21;
        let __v23 = __links[0][6] * __v16 + __links[0][7] * __v12
            + __links[0][8] * __v14;
        let __v24 = __v22 * __v23;
        let __v25 = __links[0][0] * __v16 + __links[0][1] * __v12
            + __links[0][2] * __v14;
        let __v26 = __v22 * __v25;
        let __v27 = <S as ::aim::__private::Scalar>::constant(1.0) / __v18;
        let __v28 = <S as ::aim::__private::Scalar>::select_less(
            <S as ::aim::__private::Scalar>::TINY,
            __v18,
            __v27,
            <S as ::aim::__private::Scalar>::ZERO,
        );
        let __v29 = __links[0][4] + __v12 * __v28;
        let __v30 = __v21 * __v22;
        let __v31 = __v23 * __v30;
        let __v32 = __links[0][7] * __v22 - __v29 * __v31;
        let __v33 = __links[0][3] + __v16 * __v28;
        let __v34 = __links[0][6] * __v22 - __v33 * __v31;
        let __v35 = __v15 * __v32 - __v11 * __v34;
        let __v36 = __sin_cos[0][1] * __v32 - __sin_cos[0][0] * __v34;
        let __v37 = __links[0][5] + __v14 * __v28;
        let __v38 = __links[0][8] * __v22 - __v37 * __v31;
        let __v39 = __v13 * __v36 - __v9 * __v38;
        let __v40 = __sin_cos[0][0] * __v32 + __sin_cos[0][1] * __v34;
        let __v41 = __sin_cos[0][3] * __v36 - __sin_cos[0][2] * __v38;
        let __v42 = __sin_cos[0][2] * __v36 + __sin_cos[0][3] * __v38;
        let __v43 = __links[1][1] * __v40 + __links[1][4] * __v41
            + __links[1][7] * __v42;
        let __v44 = __links[1][0] * __v40 + __links[1][3] * __v41
            + __links[1][6] * __v42;
        let __v45 = __v1 * __v43 - __v3 * __v44;
        let __v46 = __v0
            * (__links[1][2] * __v40 + __links[1][5] * __v41 + __links[1][8] * __v42);
        let __v47 = __v5 * (__sin_cos[1][1] * __v43 - __sin_cos[1][0] * __v44) - __v46;
        let __v48 = __v25 * __v30;
        let __v49 = __links[0][1] * __v22 - __v29 * __v48;
        let __v50 = __links[0][0] * __v22 - __v33 * __v48;
        let __v51 = __v15 * __v49 - __v11 * __v50;
        let __v52 = __sin_cos[0][1] * __v49 - __sin_cos[0][0] * __v50;
        let __v53 = __links[0][2] * __v22 - __v37 * __v48;
        let __v54 = __v13 * __v52 - __v9 * __v53;
        let __v55 = __sin_cos[0][0] * __v49 + __sin_cos[0][1] * __v50;
        let __v56 = __sin_cos[0][3] * __v52 - __sin_cos[0][2] * __v53;
        let __v57 = __sin_cos[0][2] * __v52 + __sin_cos[0][3] * __v53;
        let __v58 = __links[1][1] * __v55 + __links[1][4] * __v56
            + __links[1][7] * __v57;
        let __v59 = __links[1][0] * __v55 + __links[1][3] * __v56
            + __links[1][6] * __v57;
        let __v60 = __v1 * __v58 - __v3 * __v59;
        let __v61 = __v0
            * (__links[1][2] * __v55 + __links[1][5] * __v56 + __links[1][8] * __v57);
        let __v62 = __v5 * (__sin_cos[1][1] * __v58 - __sin_cos[1][0] * __v59) - __v61;
        [__v24, __v26, __v35, __v39, __v45, __v47, __v51, __v54, __v60, __v62]
    }
};

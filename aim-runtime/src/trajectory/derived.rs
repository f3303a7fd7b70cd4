//! Derived from the statement in `aim-codegen/tests/it/trajectory/objective.rs`; rewritten by
//! `AIM_BLESS=1 cargo test -p aim-codegen --test it trajectory`. A point beside the chord of its neighbours.

///α and β. 32 operations: 15 add, 14 mul, 1 div, 2 sqrt; 2 select.
#[inline]
pub(super) fn place<S: crate::Scalar>(__points: &[[S; 3]; 3]) -> [S; 2] {
    let __v0 = __points[0][0] - __points[2][0];
    let __v1 = __points[0][1] - __points[2][1];
    let __v2 = __points[0][2] - __points[2][2];
    let __v3 = __v0 * __v0 + __v1 * __v1 + __v2 * __v2;
    let __v4 = <S as crate::Scalar>::sqrt(__v3);
    let __v5 = <S as crate::Scalar>::constant(1.0) / __v4;
    let __v6 = <S as crate::Scalar>::select_less(
        <S as crate::Scalar>::TINY,
        __v4,
        __v5,
        <S as crate::Scalar>::ZERO,
    );
    let __v7 = __points[0][0] - __points[1][0];
    let __v8 = __points[0][1] - __points[1][1];
    let __v9 = __points[0][2] - __points[1][2];
    let __v10 = __v6 * (__v0 * __v7 + __v1 * __v8 + __v2 * __v9);
    let __v11 = __v6 * __v10;
    let __v12 = __v7 - __v0 * __v11;
    let __v13 = __v8 - __v1 * __v11;
    let __v14 = __v9 - __v2 * __v11;
    let __v15 = __v12 * __v12 + __v13 * __v13 + __v14 * __v14;
    let __v16 = <S as crate::Scalar>::sqrt(__v15);
    [__v10, __v16]
}
///The term and its nine derivatives. 58 operations: 25 add, 29 mul, 2 div, 2 sqrt; 4 select.
#[inline]
pub(super) fn term_gradient<S: crate::Scalar>(
    __points: &[[S; 3]; 3],
    __others: &[S; 2],
) -> [S; 10] {
    let __v0 = __points[0][0] - __points[2][0];
    let __v1 = __points[0][1] - __points[2][1];
    let __v2 = __points[0][2] - __points[2][2];
    let __v3 = __v0 * __v0 + __v1 * __v1 + __v2 * __v2;
    let __v4 = <S as crate::Scalar>::sqrt(__v3);
    let __v5 = <S as crate::Scalar>::constant(1.0) / __v4;
    let __v6 = <S as crate::Scalar>::select_less(
        <S as crate::Scalar>::TINY,
        __v4,
        __v5,
        <S as crate::Scalar>::ZERO,
    );
    let __v7 = __points[0][0] - __points[1][0];
    let __v8 = __points[0][1] - __points[1][1];
    let __v9 = __points[0][2] - __points[1][2];
    let __v10 = __v6 * (__v0 * __v7 + __v1 * __v8 + __v2 * __v9);
    let __v11 = __others[0] - __v10;
    let __v12 = __v6 * __v10;
    let __v13 = __v7 - __v0 * __v12;
    let __v14 = __v8 - __v1 * __v12;
    let __v15 = __v9 - __v2 * __v12;
    let __v16 = __v13 * __v13 + __v14 * __v14 + __v15 * __v15;
    let __v17 = <S as crate::Scalar>::sqrt(__v16);
    let __v18 = __others[1] - __v17;
    let __v19 = __v11 * __v11 + __v18 * __v18;
    let __v20 = <S as crate::Scalar>::constant(2.0) * __v18 / __v17;
    let __v21 = <S as crate::Scalar>::select_less(
        <S as crate::Scalar>::TINY,
        __v17,
        __v20,
        <S as crate::Scalar>::ZERO,
    );
    let __v22 = __v6 * (<S as crate::Scalar>::constant(2.0) * __v11 - __v10 * __v21);
    let __v23 = __v7 * __v21 + __v0 * __v22;
    let __v24 = __v13 * __v22;
    let __v25 = __v23 + __v24;
    let __v26 = __v8 * __v21 + __v1 * __v22;
    let __v27 = __v14 * __v22;
    let __v28 = __v26 + __v27;
    let __v29 = __v9 * __v21 + __v2 * __v22;
    let __v30 = __v15 * __v22;
    let __v31 = __v29 + __v30;
    [__v19, -__v25, -__v28, -__v31, __v23, __v26, __v29, __v24, __v27, __v30]
}
///α and β, rounded. 35 operations: 17 add, 15 mul, 1 div, 2 sqrt; 2 select.
#[inline]
pub(super) fn rounded_place<S: crate::Scalar>(
    __points: &[[S; 3]; 3],
    __others: &[S; 1],
) -> [S; 2] {
    let __v0 = __points[0][0] - __points[2][0];
    let __v1 = __points[0][1] - __points[2][1];
    let __v2 = __points[0][2] - __points[2][2];
    let __v3 = __others[0] * __others[0];
    let __v4 = __v0 * __v0 + __v1 * __v1 + __v2 * __v2 + __v3;
    let __v5 = <S as crate::Scalar>::sqrt(__v4);
    let __v6 = <S as crate::Scalar>::constant(1.0) / __v5;
    let __v7 = <S as crate::Scalar>::select_less(
        <S as crate::Scalar>::TINY,
        __v5,
        __v6,
        <S as crate::Scalar>::ZERO,
    );
    let __v8 = __points[0][0] - __points[1][0];
    let __v9 = __points[0][1] - __points[1][1];
    let __v10 = __points[0][2] - __points[1][2];
    let __v11 = __v7 * (__v0 * __v8 + __v1 * __v9 + __v2 * __v10);
    let __v12 = __v7 * __v11;
    let __v13 = __v8 - __v0 * __v12;
    let __v14 = __v9 - __v1 * __v12;
    let __v15 = __v10 - __v2 * __v12;
    let __v16 = __v13 * __v13 + __v14 * __v14 + __v15 * __v15 + __v3;
    let __v17 = <S as crate::Scalar>::sqrt(__v16);
    [__v11, __v17]
}
///The rounded term, its nine derivatives, and the lower triangle of its second derivatives, row by row. 774 operations: 350 add, 420 mul, 2 div, 2 sqrt; 4 select.
#[inline]
pub(super) fn rounded_term_hessian<S: crate::Scalar>(
    __points: &[[S; 3]; 3],
    __others: &[S; 3],
) -> [S; 55] {
    let __v0 = __points[0][0] - __points[1][0];
    let __v1 = __points[0][0] - __points[2][0];
    let __v2 = __points[2][1] - __points[0][1];
    let __v3 = __points[2][2] - __points[0][2];
    let __v4 = __others[0] * __others[0];
    let __v5 = __v1 * __v1 + __v2 * __v2 + __v3 * __v3 + __v4;
    let __v6 = <S as crate::Scalar>::sqrt(__v5);
    let __v7 = <S as crate::Scalar>::constant(1.0) / __v6;
    let __v8 = <S as crate::Scalar>::select_less(
        <S as crate::Scalar>::TINY,
        __v6,
        __v7,
        <S as crate::Scalar>::ZERO,
    );
    let __v9 = __v1 * __v8;
    let __v10 = __points[0][1] - __points[1][1];
    let __v11 = __v2 * __v8;
    let __v12 = __points[0][2] - __points[1][2];
    let __v13 = __v3 * __v8;
    let __v14 = __v0 * __v9 - __v10 * __v11 - __v12 * __v13;
    let __v15 = __others[1] - __v14;
    let __v16 = __v0 - __v9 * __v14;
    let __v17 = __v10 + __v11 * __v14;
    let __v18 = __v12 + __v13 * __v14;
    let __v19 = __v16 * __v16 + __v17 * __v17 + __v18 * __v18 + __v4;
    let __v20 = <S as crate::Scalar>::sqrt(__v19);
    let __v21 = __others[2] - __v20;
    let __v22 = __v15 * __v15 + __v21 * __v21;
    let __v23 = <S as crate::Scalar>::constant(1.0) / __v20;
    let __v24 = <S as crate::Scalar>::select_less(
        <S as crate::Scalar>::TINY,
        __v20,
        __v23,
        <S as crate::Scalar>::ZERO,
    );
    let __v25 = <S as crate::Scalar>::constant(2.0) * __v24;
    let __v26 = __v21 * __v25;
    let __v27 = __v16 * __v26;
    let __v28 = __v9 * __v27;
    let __v29 = __v17 * __v26;
    let __v30 = __v11 * __v29;
    let __v31 = __v18 * __v26;
    let __v32 = __v13 * __v31;
    let __v33 = <S as crate::Scalar>::constant(2.0) * __v15 - (__v28 - __v30 - __v32);
    let __v34 = __v27 + __v9 * __v33;
    let __v35 = __v0 * __v33 - __v14 * __v27;
    let __v36 = __v14 * __v29 - __v10 * __v33;
    let __v37 = __v14 * __v31 - __v12 * __v33;
    let __v38 = __v1 * __v35 + __v2 * __v36 + __v3 * __v37;
    let __v39 = __v8 * __v8;
    let __v40 = __v8 * __v39;
    let __v41 = __v1 * __v40;
    let __v42 = __v38 * __v41 - __v8 * __v35;
    let __v43 = __v42 - __v34;
    let __v44 = __v29 - __v11 * __v33;
    let __v45 = __v2 * __v40;
    let __v46 = __v8 * __v36 - __v38 * __v45;
    let __v47 = __v46 - __v44;
    let __v48 = __v31 - __v13 * __v33;
    let __v49 = __v3 * __v40;
    let __v50 = __v8 * __v37 - __v38 * __v49;
    let __v51 = __v50 - __v48;
    let __v52 = __v3 * __v41;
    let __v53 = __v8 - __v1 * __v41;
    let __v54 = __v2 * __v41;
    let __v55 = __v12 * __v52 + (__v0 * __v53 + __v10 * __v54);
    let __v56 = __v9 + __v55;
    let __v57 = __v14 * __v53;
    let __v58 = <S as crate::Scalar>::constant(1.0) - (__v9 * __v56 + __v57);
    let __v59 = __v24 * (__v25 + __v24 * __v26);
    let __v60 = __v16 * __v59;
    let __v61 = __v14 * __v52;
    let __v62 = __v61 - __v13 * __v56;
    let __v63 = __v14 * __v54;
    let __v64 = __v63 - __v11 * __v56;
    let __v65 = __v18 * __v62 - (__v16 * __v58 - __v17 * __v64);
    let __v66 = __v26 * __v58 + __v60 * __v65;
    let __v67 = __v33 * __v53;
    let __v68 = __v31 * __v52 + (__v27 * __v53 + __v29 * __v54);
    let __v69 = __v18 * __v59;
    let __v70 = __v26 * __v62 - __v69 * __v65;
    let __v71 = __v17 * __v59;
    let __v72 = __v26 * __v64 - __v71 * __v65;
    let __v73 = __v13 * __v70 + (__v9 * __v66 + __v11 * __v72);
    let __v74 = <S as crate::Scalar>::constant(2.0) * __v56 + __v68 + __v73;
    let __v75 = __v40 * __v38;
    let __v76 = __v75 + __v35 * __v41;
    let __v77 = __v0 * __v74 - (__v33 - __v27 * __v56 - __v14 * __v66);
    let __v78 = __v76 + __v8 * __v77;
    let __v79 = __v1 * __v39;
    let __v80 = __v38 * <S as crate::Scalar>::constant(3.0);
    let __v81 = __v79 * __v80 - __v35;
    let __v82 = __v3 * (__v31 * __v56 - __v14 * __v70 + __v12 * __v74);
    let __v83 = __v2 * (__v29 * __v56 - __v14 * __v72 + __v10 * __v74);
    let __v84 = __v41 * (__v81 - (__v82 + (__v83 - __v1 * __v77))) - __v78;
    let __v85 = __v9 * __v74 - (__v66 + __v67) - __v84;
    let __v86 = __v33 * __v54;
    let __v87 = __v3 * __v45;
    let __v88 = __v8 - __v2 * __v45;
    let __v89 = __v12 * __v87 - (__v10 * __v88 + __v0 * __v54);
    let __v90 = __v11 + __v89;
    let __v91 = __v9 * __v90 - __v63;
    let __v92 = __v14 * __v88;
    let __v93 = <S as crate::Scalar>::constant(1.0) - (__v92 + __v11 * __v90);
    let __v94 = __v14 * __v87;
    let __v95 = __v94 - __v13 * __v90;
    let __v96 = __v16 * __v91 + __v17 * __v93 + __v18 * __v95;
    let __v97 = __v26 * __v91 - __v60 * __v96;
    let __v98 = __v31 * __v87 - (__v27 * __v54 + __v29 * __v88);
    let __v99 = <S as crate::Scalar>::constant(2.0) * __v90 + __v98;
    let __v100 = __v26 * __v93 - __v71 * __v96;
    let __v101 = __v26 * __v95 - __v69 * __v96;
    let __v102 = __v9 * __v97 - __v11 * __v100 - __v13 * __v101 - __v99;
    let __v103 = __v35 * __v45;
    let __v104 = __v14 * __v97 - __v27 * __v90 + __v0 * __v102;
    let __v105 = __v2 * __v39;
    let __v106 = __v36 - __v105 * __v80;
    let __v107 = __v33 + __v29 * __v90 - __v14 * __v100 - __v10 * __v102;
    let __v108 = __v3 * (__v14 * __v101 - __v31 * __v90 + __v12 * __v102);
    let __v109 = __v106 + (__v1 * __v104 + __v2 * __v107 - __v108);
    let __v110 = __v103 - __v8 * __v104 + __v41 * __v109;
    let __v111 = __v9 * __v102 - (__v86 + __v97) - __v110;
    let __v112 = __v33 * __v88;
    let __v113 = __v75 + __v36 * __v45;
    let __v114 = __v8 * __v107 - __v113 - __v45 * __v109;
    let __v115 = __v100 + __v112 + __v11 * __v102 + __v114;
    let __v116 = __v33 * __v52;
    let __v117 = __v8 - __v3 * __v49;
    let __v118 = __v12 * __v117 - (__v10 * __v87 - __v0 * __v52);
    let __v119 = __v118 - __v13;
    let __v120 = __v61 + __v9 * __v119;
    let __v121 = __v94 + __v11 * __v119;
    let __v122 = __v14 * __v117;
    let __v123 = <S as crate::Scalar>::constant(1.0) - (__v122 - __v13 * __v119);
    let __v124 = __v17 * __v121 - __v16 * __v120 + __v18 * __v123;
    let __v125 = __v26 * __v120 + __v60 * __v124;
    let __v126 = __v31 * __v117 - (__v29 * __v87 - __v27 * __v52);
    let __v127 = __v26 * __v121 - __v71 * __v124;
    let __v128 = __v26 * __v123 - __v69 * __v124;
    let __v129 = __v9 * __v125 + __v11 * __v127 + __v13 * __v128;
    let __v130 = __v126 + <S as crate::Scalar>::constant(2.0) * __v119 - __v129;
    let __v131 = __v35 * __v49;
    let __v132 = __v27 * __v119 - __v14 * __v125 + __v0 * __v130;
    let __v133 = __v3 * __v39;
    let __v134 = __v37 - __v80 * __v133;
    let __v135 = __v33 - __v31 * __v119 - __v14 * __v128 - __v12 * __v130;
    let __v136 = __v29 * __v119 + __v14 * __v127 + __v10 * __v130;
    let __v137 = __v134 + (__v3 * __v135 + (__v1 * __v132 - __v2 * __v136));
    let __v138 = __v131 - __v8 * __v132 + __v41 * __v137;
    let __v139 = __v125 - __v116 + __v9 * __v130 - __v138;
    let __v140 = __v33 * __v87;
    let __v141 = __v36 * __v49;
    let __v142 = __v141 + __v8 * __v136 + __v45 * __v137;
    let __v143 = __v127 - __v140 + __v11 * __v130 - __v142;
    let __v144 = __v33 * __v117;
    let __v145 = __v75 + __v37 * __v49;
    let __v146 = __v8 * __v135 - __v145 - __v49 * __v137;
    let __v147 = __v128 + __v144 + __v13 * __v130 + __v146;
    let __v148 = <S as crate::Scalar>::constant(1.0) - __v1 * __v79;
    let __v149 = __v3 * __v79;
    let __v150 = __v2 * __v79;
    let __v151 = __v18 * __v149 + (__v16 * __v148 + __v17 * __v150);
    let __v152 = __v26 * __v148 - __v151 * __v60;
    let __v153 = __v26 * __v149;
    let __v154 = __v151 * __v69 - __v153;
    let __v155 = __v26 * __v150;
    let __v156 = __v151 * __v71 - __v155;
    let __v157 = __v9 * (__v152 + <S as crate::Scalar>::constant(2.0))
        + (__v13 * __v154 + __v11 * __v156);
    let __v158 = __v28 - __v33 + __v14 * __v152 + __v0 * __v157;
    let __v159 = __v9 * __v29 - __v14 * __v156 + __v10 * __v157;
    let __v160 = __v9 * __v31 - __v14 * __v154 + __v12 * __v157;
    let __v161 = __v1 * __v158 - __v2 * __v159 - __v3 * __v160;
    let __v162 = __v152 - __v9 * __v157;
    let __v163 = __v8 * __v158 - __v41 * __v161 - __v162;
    let __v164 = __v8 * __v159 + __v45 * __v161 + (__v156 - __v11 * __v157);
    let __v165 = __v8 * __v160 + __v49 * __v161 + (__v154 - __v13 * __v157);
    let __v166 = <S as crate::Scalar>::constant(1.0) - __v2 * __v105;
    let __v167 = __v3 * __v105;
    let __v168 = __v18 * __v167 - (__v16 * __v150 + __v17 * __v166);
    let __v169 = __v155 + __v168 * __v60;
    let __v170 = __v26 * __v166 + __v168 * __v71;
    let __v171 = __v26 * __v167;
    let __v172 = __v171 - __v168 * __v69;
    let __v173 = __v13 * __v172 + __v9 * __v169
        - __v11 * (__v170 + <S as crate::Scalar>::constant(2.0));
    let __v174 = __v14 * __v169 - __v11 * __v27 + __v0 * __v173;
    let __v175 = __v14 * __v170 - (__v30 + __v33) + __v10 * __v173;
    let __v176 = __v12 * __v173 - (__v11 * __v31 + __v14 * __v172);
    let __v177 = __v1 * __v174 - __v2 * __v175 - __v3 * __v176;
    let __v178 = __v9 * __v173 - __v169;
    let __v179 = __v8 * __v174 - __v41 * __v177 + __v178;
    let __v180 = __v170 + __v11 * __v173;
    let __v181 = __v8 * __v175 + __v45 * __v177 - __v180;
    let __v182 = __v8 * __v176 + __v49 * __v177 + (__v172 - __v13 * __v173);
    let __v183 = <S as crate::Scalar>::constant(1.0) - __v3 * __v133;
    let __v184 = __v17 * __v167 - __v16 * __v149 - __v18 * __v183;
    let __v185 = __v153 + __v60 * __v184;
    let __v186 = __v26 * __v183 + __v69 * __v184;
    let __v187 = __v171 - __v71 * __v184;
    let __v188 = __v9 * __v185 + __v11 * __v187
        - __v13 * (__v186 + <S as crate::Scalar>::constant(2.0));
    let __v189 = __v14 * __v185 - __v13 * __v27 + __v0 * __v188;
    let __v190 = __v10 * __v188 - (__v13 * __v29 + __v14 * __v187);
    let __v191 = __v14 * __v186 - (__v32 + __v33) + __v12 * __v188;
    let __v192 = __v1 * __v189 - __v2 * __v190 - __v3 * __v191;
    let __v193 = __v9 * __v188 - __v185;
    let __v194 = __v8 * __v189 - __v41 * __v192 + __v193;
    let __v195 = __v187 - __v11 * __v188;
    let __v196 = __v8 * __v190 + __v45 * __v192 + __v195;
    let __v197 = __v186 + __v13 * __v188;
    let __v198 = __v8 * __v191 + __v49 * __v192 - __v197;
    let __v199 = __v57 + __v9 * __v55;
    let __v200 = __v13 * __v55 - __v61;
    let __v201 = __v11 * __v55 - __v63;
    let __v202 = __v18 * __v200 - (__v16 * __v199 - __v17 * __v201);
    let __v203 = __v26 * __v199 + __v60 * __v202;
    let __v204 = __v68 + <S as crate::Scalar>::constant(2.0) * __v55;
    let __v205 = __v26 * __v200 - __v69 * __v202;
    let __v206 = __v26 * __v201 - __v71 * __v202;
    let __v207 = __v13 * __v205 + (__v9 * __v203 + __v11 * __v206) - __v204;
    let __v208 = __v67 - __v203 + __v9 * __v207;
    let __v209 = __v14 * __v203 - __v27 * __v55 + __v0 * __v207;
    let __v210 = __v10 * __v207 - (__v29 * __v55 + __v14 * __v206);
    let __v211 = __v12 * __v207 - (__v31 * __v55 + __v14 * __v205);
    let __v212 = __v81 - (__v1 * __v209 - __v2 * __v210 - __v3 * __v211);
    let __v213 = __v8 * __v209 - __v76 + __v41 * __v212;
    let __v214 = __v208 + __v213;
    let __v215 = __v11 * __v207 - (__v86 + __v206);
    let __v216 = __v215 - (__v36 * __v41 + __v8 * __v210 - __v45 * __v212);
    let __v217 = __v13 * __v207 - (__v116 + __v205);
    let __v218 = __v217 - (__v37 * __v41 + __v8 * __v211 - __v49 * __v212);
    let __v219 = __v9 * __v89 - __v63;
    let __v220 = __v92 + __v11 * __v89;
    let __v221 = __v94 - __v13 * __v89;
    let __v222 = __v16 * __v219 - __v17 * __v220 + __v18 * __v221;
    let __v223 = __v26 * __v219 - __v60 * __v222;
    let __v224 = __v26 * __v220 + __v71 * __v222;
    let __v225 = __v26 * __v221 - __v69 * __v222;
    let __v226 = __v9 * __v223 + __v11 * __v224 - __v13 * __v225;
    let __v227 = __v98 + <S as crate::Scalar>::constant(2.0) * __v89 - __v226;
    let __v228 = __v86 + __v223 + __v9 * __v227;
    let __v229 = __v27 * __v89 - __v14 * __v223 + __v0 * __v227;
    let __v230 = __v29 * __v89 + __v14 * __v224 + __v10 * __v227;
    let __v231 = __v31 * __v89 - __v14 * __v225 + __v12 * __v227;
    let __v232 = __v106 - (__v1 * __v229 - __v2 * __v230 - __v3 * __v231);
    let __v233 = __v103 + __v8 * __v229 + __v41 * __v232;
    let __v234 = __v228 + __v233;
    let __v235 = __v112 - __v224 - __v11 * __v227;
    let __v236 = __v8 * __v230 - __v113 - __v45 * __v232;
    let __v237 = __v235 + __v236;
    let __v238 = __v140 - __v225 + __v13 * __v227;
    let __v239 = __v238 - (__v8 * __v231 - __v37 * __v45 - __v49 * __v232);
    let __v240 = __v61 + __v9 * __v118;
    let __v241 = __v122 - __v13 * __v118;
    let __v242 = __v94 + __v11 * __v118;
    let __v243 = __v18 * __v241 - (__v17 * __v242 - __v16 * __v240);
    let __v244 = __v60 * __v243 - __v26 * __v240;
    let __v245 = __v26 * __v241 - __v69 * __v243;
    let __v246 = __v26 * __v242 + __v71 * __v243;
    let __v247 = __v13 * __v245 + (__v9 * __v244 - __v11 * __v246);
    let __v248 = __v126 + <S as crate::Scalar>::constant(2.0) * __v118 + __v247;
    let __v249 = __v9 * __v248 - (__v116 + __v244);
    let __v250 = __v27 * __v118 + __v14 * __v244 + __v0 * __v248;
    let __v251 = __v29 * __v118 + __v14 * __v246 + __v10 * __v248;
    let __v252 = __v31 * __v118 - __v14 * __v245 + __v12 * __v248;
    let __v253 = __v134 + (__v1 * __v250 - __v2 * __v251 - __v3 * __v252);
    let __v254 = __v131 - __v8 * __v250 + __v41 * __v253;
    let __v255 = __v249 - __v254;
    let __v256 = __v140 - __v246 - __v11 * __v248;
    let __v257 = __v141 + __v8 * __v251 + __v45 * __v253;
    let __v258 = __v256 + __v257;
    let __v259 = __v144 - __v245 + __v13 * __v248;
    let __v260 = __v145 + __v8 * __v252 + __v49 * __v253;
    let __v261 = __v259 - __v260;
    [
        __v22,
        __v43,
        __v47,
        __v51,
        __v34,
        __v44,
        __v48,
        -__v42,
        -__v46,
        -__v50,
        __v85,
        __v111,
        -__v115,
        __v139,
        -__v143,
        -__v147,
        -__v163,
        -__v164,
        -__v165,
        -__v162,
        -__v179,
        -__v181,
        -__v182,
        __v178,
        -__v180,
        -__v194,
        -__v196,
        -__v198,
        __v193,
        __v195,
        -__v197,
        __v214,
        -__v216,
        -__v218,
        -__v208,
        __v215,
        __v217,
        -__v213,
        __v234,
        __v237,
        -__v239,
        -__v228,
        -__v235,
        __v238,
        -__v233,
        -__v236,
        -__v255,
        -__v258,
        __v261,
        __v249,
        __v256,
        -__v259,
        -__v254,
        __v257,
        __v260,
    ]
}

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
///The rounded term, its nine derivatives, and the lower triangle of its second derivatives, row by row. 764 operations: 353 add, 407 mul, 2 div, 2 sqrt; 4 select.
#[inline]
pub(super) fn rounded_term_hessian<S: crate::Scalar>(
    __points: &[[S; 3]; 3],
    __others: &[S; 3],
) -> [S; 55] {
    let __v0 = __points[2][0] - __points[0][0];
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
    let __v11 = __v1 * __v9 - __v0 * __v8 + __v2 * __v10;
    let __v12 = __v7 * __v11;
    let __v13 = __others[1] - __v12;
    let __v14 = __v7 * __v7;
    let __v15 = __v11 * __v14;
    let __v16 = __v8 + __v0 * __v15;
    let __v17 = __v9 - __v1 * __v15;
    let __v18 = __v10 - __v2 * __v15;
    let __v19 = __v16 * __v16 + __v17 * __v17 + __v18 * __v18 + __v3;
    let __v20 = <S as crate::Scalar>::sqrt(__v19);
    let __v21 = __others[2] - __v20;
    let __v22 = __v13 * __v13 + __v21 * __v21;
    let __v23 = <S as crate::Scalar>::constant(1.0) / __v20;
    let __v24 = <S as crate::Scalar>::select_less(
        <S as crate::Scalar>::TINY,
        __v20,
        __v23,
        <S as crate::Scalar>::ZERO,
    );
    let __v25 = <S as crate::Scalar>::constant(2.0) * __v24;
    let __v26 = __v21 * __v25;
    let __v27 = __v0 * __v7;
    let __v28 = __v7 * __v26;
    let __v29 = __v1 * __v17 - __v0 * __v16 + __v2 * __v18;
    let __v30 = <S as crate::Scalar>::constant(2.0) * __v13 - __v28 * __v29;
    let __v31 = __v16 * __v26 - __v27 * __v30;
    let __v32 = __v11 * __v28;
    let __v33 = __v8 * __v30 - __v16 * __v32;
    let __v34 = __v7 * __v14;
    let __v35 = __v0 * __v34;
    let __v36 = __v9 * __v30 - __v17 * __v32;
    let __v37 = __v10 * __v30 - __v18 * __v32;
    let __v38 = __v1 * __v36 - __v0 * __v33 + __v2 * __v37;
    let __v39 = __v7 * __v33 + __v35 * __v38;
    let __v40 = __v31 + __v39;
    let __v41 = __v1 * __v7;
    let __v42 = __v17 * __v26 + __v41 * __v30;
    let __v43 = __v1 * __v34;
    let __v44 = __v7 * __v36 - __v43 * __v38;
    let __v45 = __v42 + __v44;
    let __v46 = __v2 * __v7;
    let __v47 = __v18 * __v26 + __v46 * __v30;
    let __v48 = __v2 * __v34;
    let __v49 = __v7 * __v37 - __v48 * __v38;
    let __v50 = __v47 + __v49;
    let __v51 = __v35 * __v33;
    let __v52 = __v7 * __v30;
    let __v53 = __v34 * __v38;
    let __v54 = __v52 - __v53;
    let __v55 = __v2 * __v35;
    let __v56 = __v7 - __v0 * __v35;
    let __v57 = __v1 * __v35;
    let __v58 = __v10 * __v55 + (__v8 * __v56 + __v9 * __v57);
    let __v59 = __v58 - __v27;
    let __v60 = __v0 * __v28;
    let __v61 = <S as crate::Scalar>::constant(1.0) - __v12 * __v56;
    let __v62 = __v7 * __v29;
    let __v63 = __v12 * __v17;
    let __v64 = __v12 * __v18;
    let __v65 = __v16 * __v61 - __v57 * __v63 - __v55 * __v64;
    let __v66 = __v59 * __v62 - __v65;
    let __v67 = __v24 * (__v25 + __v24 * __v26);
    let __v68 = __v16 * __v67;
    let __v69 = __v59 * __v60 + __v26 * __v61 + __v66 * __v68;
    let __v70 = __v30 * __v56;
    let __v71 = __v55 * __v18 + (__v16 * __v56 + __v57 * __v17);
    let __v72 = __v26 * __v71;
    let __v73 = __v1 * __v28;
    let __v74 = __v57 * __v32;
    let __v75 = __v17 * __v67;
    let __v76 = __v1 * (__v59 * __v73 + __v74 - __v66 * __v75);
    let __v77 = __v2 * __v28;
    let __v78 = __v55 * __v32;
    let __v79 = __v18 * __v67;
    let __v80 = __v2 * (__v59 * __v77 + __v78 - __v66 * __v79);
    let __v81 = __v0 * __v69 + __v76 + __v80;
    let __v82 = <S as crate::Scalar>::constant(2.0) * __v59 + __v72 - __v7 * __v81;
    let __v83 = __v26 * __v29;
    let __v84 = __v0 * __v30;
    let __v85 = __v14 * __v38;
    let __v86 = __v0 * __v85;
    let __v87 = <S as crate::Scalar>::constant(2.0) * __v85;
    let __v88 = __v0 * __v87;
    let __v89 = __v12 * __v81;
    let __v90 = __v59 * __v83 - (__v33 + (__v86 - __v84 + __v88)) - __v89;
    let __v91 = __v0 * (__v7 * __v82 - __v34 * (__v90 + __v11 * __v82));
    let __v92 = __v16 * __v28;
    let __v93 = __v92 * __v59 - (__v51 + (__v54 + (__v69 + (__v70 + __v91))));
    let __v94 = __v7 * __v8;
    let __v95 = __v93 + __v15 * __v69 + __v94 * __v82;
    let __v96 = __v7 - __v1 * __v43;
    let __v97 = __v2 * __v43;
    let __v98 = __v10 * __v97 - (__v8 * __v57 + __v9 * __v96);
    let __v99 = __v41 - __v98;
    let __v100 = __v12 * __v16;
    let __v101 = <S as crate::Scalar>::constant(1.0) - __v12 * __v96;
    let __v102 = __v17 * __v101 - __v57 * __v100 + __v97 * __v64;
    let __v103 = __v62 * __v99 - __v102;
    let __v104 = __v74 - __v60 * __v99 - __v103 * __v68;
    let __v105 = __v57 * __v30;
    let __v106 = __v97 * __v18 - (__v57 * __v16 + __v17 * __v96);
    let __v107 = __v26 * __v106;
    let __v108 = __v73 * __v99 - __v26 * __v101 - __v103 * __v75;
    let __v109 = __v97 * __v32;
    let __v110 = __v2 * (__v77 * __v99 - __v109 - __v103 * __v79);
    let __v111 = __v1 * __v108 - __v0 * __v104 + __v110;
    let __v112 = <S as crate::Scalar>::constant(2.0) * __v99 - __v107 - __v7 * __v111;
    let __v113 = __v1 * __v30;
    let __v114 = __v1 * __v85;
    let __v115 = __v1 * __v87;
    let __v116 = __v12 * __v111;
    let __v117 = __v83 * __v99 - (__v36 + (__v113 - __v114 - __v115)) - __v116;
    let __v118 = __v7 * __v112 - __v34 * (__v117 + __v11 * __v112);
    let __v119 = __v43 * __v33;
    let __v120 = __v104 - (__v105 + __v0 * __v118) + __v119 + __v92 * __v99;
    let __v121 = __v120 - __v15 * __v104 + __v94 * __v112;
    let __v122 = __v43 * __v36;
    let __v123 = __v30 * __v96;
    let __v124 = __v17 * __v28;
    let __v125 = __v124 * __v99;
    let __v126 = __v122 - (__v54 - (__v108 - (__v123 - __v1 * __v118))) + __v125;
    let __v127 = __v7 * __v9;
    let __v128 = __v126 - __v15 * __v108 + __v127 * __v112;
    let __v129 = __v7 - __v2 * __v48;
    let __v130 = __v10 * __v129 - (__v9 * __v97 - __v8 * __v55);
    let __v131 = __v130 + __v46;
    let __v132 = <S as crate::Scalar>::constant(1.0) - __v12 * __v129;
    let __v133 = __v97 * __v63 - __v55 * __v100 + __v18 * __v132;
    let __v134 = __v62 * __v131 - __v133;
    let __v135 = __v78 - __v60 * __v131 - __v134 * __v68;
    let __v136 = __v55 * __v30;
    let __v137 = __v18 * __v129 - (__v97 * __v17 - __v55 * __v16);
    let __v138 = __v26 * __v137;
    let __v139 = __v73 * __v131 - __v109 - __v134 * __v75;
    let __v140 = __v77 * __v131 - __v26 * __v132 - __v134 * __v79;
    let __v141 = __v1 * __v139 - __v0 * __v135 + __v2 * __v140;
    let __v142 = <S as crate::Scalar>::constant(2.0) * __v131 + __v138 - __v7 * __v141;
    let __v143 = __v2 * __v30;
    let __v144 = __v2 * __v85;
    let __v145 = __v2 * __v87;
    let __v146 = __v12 * __v141;
    let __v147 = __v83 * __v131 - (__v37 + (__v143 - __v144 - __v145)) - __v146;
    let __v148 = __v7 * __v142 - __v34 * (__v147 + __v11 * __v142);
    let __v149 = __v48 * __v33;
    let __v150 = __v135 - (__v136 + __v0 * __v148) + __v149 + __v92 * __v131;
    let __v151 = __v150 - __v15 * __v135 + __v94 * __v142;
    let __v152 = __v97 * __v30;
    let __v153 = __v48 * __v36;
    let __v154 = __v139 + (__v152 + __v1 * __v148) + __v153 + __v124 * __v131;
    let __v155 = __v154 - __v15 * __v139 + __v127 * __v142;
    let __v156 = __v48 * __v37;
    let __v157 = __v30 * __v129;
    let __v158 = __v18 * __v28;
    let __v159 = __v158 * __v131;
    let __v160 = __v156 - (__v54 - (__v140 - (__v157 - __v2 * __v148))) + __v159;
    let __v161 = __v7 * __v10;
    let __v162 = __v160 - __v15 * __v140 + __v161 * __v142;
    let __v163 = __v14 * __v26;
    let __v164 = __v0 * __v163;
    let __v165 = __v14 * __v29;
    let __v166 = __v16 + __v0 * __v165;
    let __v167 = __v26 - __v0 * __v164 - __v166 * __v68;
    let __v168 = __v2 * __v164;
    let __v169 = __v166 * __v79 - __v168;
    let __v170 = __v1 * __v164;
    let __v171 = __v166 * __v75 - __v170;
    let __v172 = __v2 * __v169 + (__v0 * __v167 + __v1 * __v171);
    let __v173 = <S as crate::Scalar>::constant(2.0) * __v27 + __v7 * __v172;
    let __v174 = __v52 + __v16 * __v164 - __v15 * __v167 + __v94 * __v173;
    let __v175 = __v29 * __v60 - __v84 + __v12 * __v172 + __v11 * __v173;
    let __v176 = __v27 * __v173 - __v167;
    let __v177 = __v174 + __v35 * __v175 - __v176;
    let __v178 = __v15 * __v171 - (__v171 - __v17 * __v164 + __v43 * __v175);
    let __v179 = (__v41 + __v127) * __v173 + __v178;
    let __v180 = __v46 + __v161;
    let __v181 = __v15 * __v169 - (__v169 - __v18 * __v164 + __v48 * __v175);
    let __v182 = __v180 * __v173 + __v181;
    let __v183 = __v1 * __v163;
    let __v184 = __v17 - __v1 * __v165;
    let __v185 = __v184 * __v68 - __v170;
    let __v186 = __v26 - __v1 * __v183 - __v184 * __v75;
    let __v187 = __v2 * __v183;
    let __v188 = __v187 + __v184 * __v79;
    let __v189 = __v2 * __v188 - (__v0 * __v185 + __v1 * __v186);
    let __v190 = <S as crate::Scalar>::constant(2.0) * __v41 - __v7 * __v189;
    let __v191 = __v113 - __v29 * __v73 + __v12 * __v189 - __v11 * __v190;
    let __v192 = __v35 * __v191;
    let __v193 = __v16 * __v183 - __v15 * __v185 + __v94 * __v190 - __v192;
    let __v194 = __v185 - __v27 * __v190;
    let __v195 = __v193 + __v194;
    let __v196 = __v52 - __v17 * __v183 - __v15 * __v186 - __v127 * __v190;
    let __v197 = __v186 - __v41 * __v190;
    let __v198 = __v196 - __v43 * __v191 + __v197;
    let __v199 = __v15 * __v188 - (__v188 + __v18 * __v183 + __v48 * __v191);
    let __v200 = __v199 - __v180 * __v190;
    let __v201 = __v2 * __v163;
    let __v202 = __v18 - __v2 * __v165;
    let __v203 = __v202 * __v68 - __v168;
    let __v204 = __v26 - __v2 * __v201 - __v202 * __v79;
    let __v205 = __v187 + __v202 * __v75;
    let __v206 = __v2 * __v204 - (__v1 * __v205 - __v0 * __v203);
    let __v207 = <S as crate::Scalar>::constant(2.0) * __v46 + __v7 * __v206;
    let __v208 = __v143 - __v29 * __v77 - __v12 * __v206 - __v11 * __v207;
    let __v209 = __v35 * __v208;
    let __v210 = __v16 * __v201 - __v15 * __v203 + __v94 * __v207 - __v209;
    let __v211 = __v203 - __v27 * __v207;
    let __v212 = __v210 + __v211;
    let __v213 = __v43 * __v208;
    let __v214 = __v17 * __v201 - __v15 * __v205 + __v127 * __v207 + __v213;
    let __v215 = __v205 + __v41 * __v207;
    let __v216 = __v214 + __v215;
    let __v217 = __v52 - __v18 * __v201 - __v15 * __v204 - __v161 * __v207;
    let __v218 = __v204 - __v46 * __v207;
    let __v219 = __v217 - __v48 * __v208 + __v218;
    let __v220 = __v58 * __v62 + __v12 * __v71;
    let __v221 = __v58 * __v60 - __v56 * __v32 + __v220 * __v68;
    let __v222 = __v220 * __v75 - (__v58 * __v73 + __v74);
    let __v223 = __v220 * __v79 - (__v58 * __v77 + __v78);
    let __v224 = __v1 * __v222 - __v0 * __v221 + __v2 * __v223;
    let __v225 = __v72 + <S as crate::Scalar>::constant(2.0) * __v58 + __v7 * __v224;
    let __v226 = __v221 + __v70 + __v27 * __v225;
    let __v227 = __v94 * __v225;
    let __v228 = __v92 * __v58 + (__v53 - __v51) + __v15 * __v221 + __v227;
    let __v229 = __v33 + (__v86 + __v88) - __v58 * __v83 - __v12 * __v224;
    let __v230 = __v229 - __v11 * __v225;
    let __v231 = __v35 * __v230 - __v228;
    let __v232 = __v226 + __v231;
    let __v233 = __v41 * __v225 - (__v105 + __v222);
    let __v234 = __v127 * __v225;
    let __v235 = __v35 * __v36 - __v124 * __v58 - __v15 * __v222 - __v234;
    let __v236 = __v233 - (__v235 - __v43 * __v230);
    let __v237 = __v46 * __v225 - (__v136 + __v223);
    let __v238 = __v161 * __v225;
    let __v239 = __v35 * __v37 - __v158 * __v58 - __v15 * __v223 - __v238;
    let __v240 = __v237 - (__v239 - __v48 * __v230);
    let __v241 = __v62 * __v98 + __v12 * __v106;
    let __v242 = __v60 * __v98 + __v74 + __v241 * __v68;
    let __v243 = __v73 * __v98 - __v96 * __v32 - __v241 * __v75;
    let __v244 = __v77 * __v98 + __v109 - __v241 * __v79;
    let __v245 = __v0 * __v242 + __v1 * __v243 + __v2 * __v244;
    let __v246 = __v107 + <S as crate::Scalar>::constant(2.0) * __v98 - __v7 * __v245;
    let __v247 = __v242 - __v105 + __v27 * __v246;
    let __v248 = __v92 * __v98 - __v119 + __v15 * __v242 + __v94 * __v246;
    let __v249 = __v36 - (__v114 + __v115) + __v83 * __v98 - __v12 * __v245;
    let __v250 = __v249 + __v11 * __v246;
    let __v251 = __v248 + __v35 * __v250;
    let __v252 = __v247 - __v251;
    let __v253 = __v243 + __v123 + __v41 * __v246;
    let __v254 = __v127 * __v246;
    let __v255 = __v124 * __v98 - (__v53 + __v122) - __v15 * __v243 + __v254;
    let __v256 = __v255 - __v43 * __v250;
    let __v257 = __v253 + __v256;
    let __v258 = __v152 - __v244 - __v46 * __v246;
    let __v259 = __v161 * __v246;
    let __v260 = __v158 * __v98 - __v43 * __v37 - __v15 * __v244 + __v259;
    let __v261 = __v258 - (__v260 - __v48 * __v250);
    let __v262 = __v62 * __v130 + __v12 * __v137;
    let __v263 = __v78 - __v60 * __v130 - __v262 * __v68;
    let __v264 = __v73 * __v130 - __v109 - __v262 * __v75;
    let __v265 = __v77 * __v130 + __v129 * __v32 - __v262 * __v79;
    let __v266 = __v1 * __v264 - __v0 * __v263 + __v2 * __v265;
    let __v267 = __v138 + <S as crate::Scalar>::constant(2.0) * __v130 - __v7 * __v266;
    let __v268 = __v263 - __v136 - __v27 * __v267;
    let __v269 = __v92 * __v130 + __v149 - __v15 * __v263 + __v94 * __v267;
    let __v270 = __v83 * __v130 - (__v37 - (__v144 + __v145)) - __v12 * __v266;
    let __v271 = __v270 + __v11 * __v267;
    let __v272 = __v269 + __v35 * __v271;
    let __v273 = __v268 + __v272;
    let __v274 = __v264 + __v152 + __v41 * __v267;
    let __v275 = __v124 * __v130 + __v153 - __v15 * __v264 + __v127 * __v267;
    let __v276 = __v275 - __v43 * __v271;
    let __v277 = __v274 + __v276;
    let __v278 = __v157 - __v265 - __v46 * __v267;
    let __v279 = __v161 * __v267;
    let __v280 = __v53 + __v156 + __v158 * __v130 - __v15 * __v265 + __v279;
    let __v281 = __v280 - __v48 * __v271;
    let __v282 = __v278 - __v281;
    [
        __v22,
        -__v40,
        -__v45,
        -__v50,
        __v31,
        __v42,
        __v47,
        __v39,
        __v44,
        __v49,
        __v95,
        __v121,
        __v128,
        __v151,
        __v155,
        __v162,
        __v177,
        __v179,
        __v182,
        __v176,
        -__v195,
        __v198,
        __v200,
        __v194,
        -__v197,
        -__v212,
        -__v216,
        __v219,
        __v211,
        __v215,
        -__v218,
        __v232,
        -__v236,
        -__v240,
        -__v226,
        __v233,
        __v237,
        -__v231,
        -__v252,
        __v257,
        -__v261,
        __v247,
        -__v253,
        __v258,
        -__v251,
        -__v256,
        -__v273,
        -__v277,
        __v282,
        __v268,
        __v274,
        -__v278,
        __v272,
        __v276,
        __v281,
    ]
}

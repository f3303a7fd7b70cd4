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
    let __v7 = __points[0][2] - __points[1][2];
    let __v8 = __points[0][0] - __points[1][0];
    let __v9 = __points[0][1] - __points[1][1];
    let __v10 = __v6 * (__v7 * __v2 + __v8 * __v0 + __v9 * __v1);
    let __v11 = __others[0] - __v10;
    let __v12 = __v6 * __v10;
    let __v13 = __v8 - __v0 * __v12;
    let __v14 = __v9 - __v1 * __v12;
    let __v15 = __v7 - __v2 * __v12;
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
    let __v23 = __v8 * __v21 + __v0 * __v22;
    let __v24 = __v13 * __v22;
    let __v25 = __v23 + __v24;
    let __v26 = __v9 * __v21 + __v1 * __v22;
    let __v27 = __v14 * __v22;
    let __v28 = __v26 + __v27;
    let __v29 = __v7 * __v21 + __v2 * __v22;
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
///The rounded term, its nine derivatives, and the lower triangle of its second derivatives, row by row. 745 operations: 343 add, 398 mul, 2 div, 2 sqrt; 4 select.
#[inline]
pub(super) fn rounded_term_hessian<S: crate::Scalar>(
    __points: &[[S; 3]; 3],
    __others: &[S; 3],
) -> [S; 55] {
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
    let __v10 = __v1 * __v9;
    let __v11 = __v0 * __v8 + __v10;
    let __v12 = __points[0][2] - __points[1][2];
    let __v13 = __v2 * __v12;
    let __v14 = __v11 + __v13;
    let __v15 = __v7 * __v14;
    let __v16 = __others[1] - __v15;
    let __v17 = __v7 * __v7;
    let __v18 = __v14 * __v17;
    let __v19 = __v8 - __v0 * __v18;
    let __v20 = __v9 - __v1 * __v18;
    let __v21 = __v12 - __v2 * __v18;
    let __v22 = __v19 * __v19 + __v20 * __v20 + __v21 * __v21 + __v3;
    let __v23 = <S as crate::Scalar>::sqrt(__v22);
    let __v24 = __others[2] - __v23;
    let __v25 = __v16 * __v16 + __v24 * __v24;
    let __v26 = <S as crate::Scalar>::constant(1.0) / __v23;
    let __v27 = <S as crate::Scalar>::select_less(
        <S as crate::Scalar>::TINY,
        __v23,
        __v26,
        <S as crate::Scalar>::ZERO,
    );
    let __v28 = <S as crate::Scalar>::constant(2.0) * __v27;
    let __v29 = __v24 * __v28;
    let __v30 = __v7 * __v29;
    let __v31 = __v19 * __v30;
    let __v32 = __v1 * __v20;
    let __v33 = __v0 * __v19 + __v32;
    let __v34 = __v2 * __v21;
    let __v35 = __v33 + __v34;
    let __v36 = <S as crate::Scalar>::constant(2.0) * __v16 - __v30 * __v35;
    let __v37 = __v14 * __v31 - __v8 * __v36;
    let __v38 = __v7 * __v17;
    let __v39 = __v0 * __v38;
    let __v40 = __v20 * __v30;
    let __v41 = __v14 * __v40 - __v9 * __v36;
    let __v42 = __v21 * __v30;
    let __v43 = __v14 * __v42 - __v12 * __v36;
    let __v44 = __v0 * __v37 + __v1 * __v41 + __v2 * __v43;
    let __v45 = __v7 * __v37 - __v39 * __v44;
    let __v46 = __v19 * __v29;
    let __v47 = __v7 * __v36;
    let __v48 = __v46 + __v0 * __v47;
    let __v49 = __v45 - __v48;
    let __v50 = __v1 * __v38;
    let __v51 = __v7 * __v41 - __v50 * __v44;
    let __v52 = __v20 * __v29;
    let __v53 = __v52 + __v1 * __v47;
    let __v54 = __v51 - __v53;
    let __v55 = __v2 * __v38;
    let __v56 = __v7 * __v43 - __v55 * __v44;
    let __v57 = __v21 * __v29;
    let __v58 = __v57 + __v2 * __v47;
    let __v59 = __v56 - __v58;
    let __v60 = __v7 - __v0 * __v39;
    let __v61 = __v8 * __v60 - __v39 * (__v10 + __v13);
    let __v62 = __v0 * __v7;
    let __v63 = __v61 + __v62;
    let __v64 = <S as crate::Scalar>::constant(1.0) - __v15 * __v60;
    let __v65 = __v0 * __v30;
    let __v66 = __v27 * (__v28 + __v27 * __v29);
    let __v67 = __v19 * __v66;
    let __v68 = __v7 * __v35;
    let __v69 = __v39 * (__v34 + __v32);
    let __v70 = __v19 * __v64 - __v68 * __v63 + __v15 * __v69;
    let __v71 = __v29 * __v64 - __v65 * __v63 - __v67 * __v70;
    let __v72 = __v38 * __v44;
    let __v73 = __v72 + __v47;
    let __v74 = __v36 * __v60;
    let __v75 = __v39 * __v37;
    let __v76 = __v2 * __v30;
    let __v77 = __v14 * __v39;
    let __v78 = __v76 * __v77;
    let __v79 = __v21 * __v66;
    let __v80 = __v1 * __v30;
    let __v81 = __v80 * __v77;
    let __v82 = __v20 * __v66;
    let __v83 = __v1 * (__v80 * __v63 - __v81 + __v82 * __v70);
    let __v84 = __v0 * __v71 - __v83;
    let __v85 = __v2 * (__v76 * __v63 - __v78 + __v79 * __v70) - __v84;
    let __v86 = __v7 * __v85;
    let __v87 = __v19 * __v60 - __v69;
    let __v88 = __v29 * __v87;
    let __v89 = <S as crate::Scalar>::constant(2.0) * __v63 + __v88 - __v86;
    let __v90 = __v0 * __v36;
    let __v91 = __v29 * __v35;
    let __v92 = __v0 * __v17;
    let __v93 = __v44 * <S as crate::Scalar>::constant(3.0);
    let __v94 = __v92 * __v93;
    let __v95 = __v37 - __v90 + (__v91 * __v63 - __v94);
    let __v96 = __v39 * (__v14 * (__v86 - __v89) - __v95);
    let __v97 = __v73 + __v74 + __v75 - __v18 * __v71 - __v96;
    let __v98 = __v62 + __v7 * __v8;
    let __v99 = __v31 * __v63 - __v71 - __v97 + __v98 * __v89;
    let __v100 = __v1 * __v7;
    let __v101 = __v1 * __v39;
    let __v102 = __v7 - __v1 * __v50;
    let __v103 = __v1 * __v55;
    let __v104 = __v8 * __v101 - __v9 * __v102 + __v12 * __v103;
    let __v105 = __v100 - __v104;
    let __v106 = __v101 * __v19;
    let __v107 = __v21 * __v103;
    let __v108 = __v106 - __v20 * __v102 + __v107;
    let __v109 = __v29 * __v108;
    let __v110 = __v80 * (__v14 * __v55);
    let __v111 = <S as crate::Scalar>::constant(1.0) - __v15 * __v102;
    let __v112 = __v20 * __v111 - __v68 * __v105 + __v15 * (__v106 + __v107);
    let __v113 = __v81 - __v65 * __v105 - __v67 * __v112;
    let __v114 = __v29 * __v111 - __v80 * __v105 - __v82 * __v112;
    let __v115 = __v0 * __v113 + __v1 * __v114;
    let __v116 = __v2 * (__v76 * __v105 - __v110 + __v79 * __v112) - __v115;
    let __v117 = __v7 * __v116;
    let __v118 = <S as crate::Scalar>::constant(2.0) * __v105 - __v109 - __v117;
    let __v119 = __v101 * __v36;
    let __v120 = __v1 * __v17;
    let __v121 = __v120 * (<S as crate::Scalar>::constant(2.0) * __v44);
    let __v122 = __v44 * __v120;
    let __v123 = __v1 * __v36;
    let __v124 = __v14 * (__v117 - __v118);
    let __v125 = __v121 - (__v91 * __v105 - __v122) - (__v41 - __v123) + __v124;
    let __v126 = __v50 * __v37;
    let __v127 = __v39 * __v125 - (__v126 - __v18 * __v113);
    let __v128 = __v98 * __v118 - (__v113 - (__v119 + __v31 * __v105) - __v127);
    let __v129 = __v100 + __v7 * __v9;
    let __v130 = __v36 * __v102;
    let __v131 = __v50 * __v41;
    let __v132 = __v50 * __v125 - (__v73 + __v130 + __v131 - __v18 * __v114);
    let __v133 = __v129 * __v118 - (__v114 - __v40 * __v105 - __v132);
    let __v134 = __v7 - __v2 * __v55;
    let __v135 = __v12 * __v134 - __v11 * __v55;
    let __v136 = __v2 * __v7;
    let __v137 = __v135 + __v136;
    let __v138 = __v55 * __v33;
    let __v139 = __v21 * __v134 - __v138;
    let __v140 = __v29 * __v139;
    let __v141 = <S as crate::Scalar>::constant(1.0) - __v15 * __v134;
    let __v142 = __v21 * __v141 - __v68 * __v137 + __v15 * __v138;
    let __v143 = __v78 - __v65 * __v137 - __v67 * __v142;
    let __v144 = __v110 - __v80 * __v137 - __v82 * __v142;
    let __v145 = __v29 * __v141 - __v76 * __v137 - __v79 * __v142;
    let __v146 = __v7 * (__v0 * __v143 + __v1 * __v144 + __v2 * __v145);
    let __v147 = <S as crate::Scalar>::constant(2.0) * __v137 + __v140 + __v146;
    let __v148 = __v2 * __v36;
    let __v149 = __v39 * __v148;
    let __v150 = __v55 * __v37;
    let __v151 = __v2 * __v17;
    let __v152 = __v151 * __v93;
    let __v153 = __v14 * (__v147 + __v146);
    let __v154 = __v43 - __v148 + (__v91 * __v137 - __v152) + __v153;
    let __v155 = __v150 - __v18 * __v143 + __v39 * __v154;
    let __v156 = __v98 * __v147 - (__v143 - (__v149 + __v31 * __v137) + __v155);
    let __v157 = __v36 * __v103;
    let __v158 = __v55 * __v41;
    let __v159 = __v158 - __v18 * __v144 + __v50 * __v154;
    let __v160 = __v129 * __v147 - (__v144 - (__v157 + __v40 * __v137) + __v159);
    let __v161 = __v136 + __v7 * __v12;
    let __v162 = __v36 * __v134;
    let __v163 = __v55 * __v43;
    let __v164 = __v73 + __v162 + __v163 - __v18 * __v145 + __v55 * __v154;
    let __v165 = __v161 * __v147 - (__v145 - __v42 * __v137 + __v164);
    let __v166 = __v29 * __v92;
    let __v167 = __v2 * __v166;
    let __v168 = __v19 - __v35 * __v92;
    let __v169 = __v167 + __v79 * __v168;
    let __v170 = __v29 - __v0 * __v166 - __v67 * __v168;
    let __v171 = __v1 * __v166;
    let __v172 = __v171 + __v82 * __v168;
    let __v173 = __v2 * __v169 - (__v0 * __v170 - __v1 * __v172);
    let __v174 = <S as crate::Scalar>::constant(2.0) * __v0 - __v173;
    let __v175 = __v7 * __v174;
    let __v176 = __v90 - __v35 * __v65 + __v14 * (__v7 * __v173 - __v175);
    let __v177 = __v92 * (__v46 + __v7 * __v176);
    let __v178 = __v170 - __v92 * __v174;
    let __v179 = __v8 * __v17;
    let __v180 = __v178 + __v47 - (__v18 * __v170 + __v179 * __v174) - __v177;
    let __v181 = __v18 * __v172 - (__v172 + __v20 * __v166 + __v50 * __v176);
    let __v182 = __v181 - __v129 * __v175;
    let __v183 = __v18 * __v169 - (__v169 + __v21 * __v166 + __v55 * __v176);
    let __v184 = __v183 - __v161 * __v175;
    let __v185 = __v29 * __v120;
    let __v186 = __v20 - __v35 * __v120;
    let __v187 = __v171 + __v67 * __v186;
    let __v188 = __v2 * __v185;
    let __v189 = __v188 + __v79 * __v186;
    let __v190 = __v29 - __v1 * __v185 - __v82 * __v186;
    let __v191 = __v2 * __v189 - (__v1 * __v190 - __v0 * __v187);
    let __v192 = <S as crate::Scalar>::constant(2.0) * __v1 - __v191;
    let __v193 = __v7 * __v192;
    let __v194 = __v123 - __v35 * __v80 + __v14 * (__v7 * __v191 - __v193);
    let __v195 = __v39 * __v194;
    let __v196 = __v19 * __v185 - __v18 * __v187 + __v179 * __v192 + __v195;
    let __v197 = __v187 + __v92 * __v192;
    let __v198 = __v196 + __v197;
    let __v199 = __v190 - __v120 * __v192;
    let __v200 = __v9 * __v17;
    let __v201 = __v199 + __v47 - (__v18 * __v190 + __v200 * __v192);
    let __v202 = __v120 * (__v52 + __v7 * __v194) - __v201;
    let __v203 = __v18 * __v189 - (__v189 + __v21 * __v185 + __v55 * __v194);
    let __v204 = __v161 * __v193 - __v203;
    let __v205 = __v21 - __v35 * __v151;
    let __v206 = __v167 + __v67 * __v205;
    let __v207 = __v29 * __v151;
    let __v208 = __v29 - __v2 * __v207 - __v79 * __v205;
    let __v209 = __v188 + __v82 * __v205;
    let __v210 = __v2 * __v208 - (__v0 * __v206 + __v1 * __v209);
    let __v211 = __v210 + <S as crate::Scalar>::constant(2.0) * __v2;
    let __v212 = __v206 + __v92 * __v211;
    let __v213 = __v148 - __v35 * __v76 - __v14 * (__v7 * (__v210 + __v211));
    let __v214 = __v39 * __v213;
    let __v215 = __v19 * __v207 - __v18 * __v206 + __v179 * __v211 + __v214;
    let __v216 = __v212 + __v215;
    let __v217 = __v209 + __v120 * __v211;
    let __v218 = __v50 * __v213;
    let __v219 = __v20 * __v207 - __v18 * __v209 + __v200 * __v211 + __v218;
    let __v220 = __v217 + __v219;
    let __v221 = __v208 - __v151 * __v211;
    let __v222 = __v221 + __v47 - (__v18 * __v208 + __v17 * (__v12 * __v211));
    let __v223 = __v222 - __v151 * (__v57 + __v7 * __v213);
    let __v224 = __v7 * (__v35 * __v61 + __v14 * __v87);
    let __v225 = __v30 * (__v14 * __v60 + __v0 * __v61) - __v67 * __v224;
    let __v226 = __v79 * __v224 - (__v76 * __v61 - __v78);
    let __v227 = __v82 * __v224 - (__v80 * __v61 - __v81);
    let __v228 = __v7 * (__v2 * __v226 - (__v0 * __v225 - __v1 * __v227));
    let __v229 = __v88 + <S as crate::Scalar>::constant(2.0) * __v61 + __v228;
    let __v230 = __v7 * __v229;
    let __v231 = __v74 - __v225 - __v0 * __v230;
    let __v232 = __v8 * __v230;
    let __v233 = __v72 + __v75 - __v31 * __v61 + __v18 * __v225 - __v232;
    let __v234 = __v37 + __v91 * __v61 - __v94 + __v14 * (__v229 + __v228);
    let __v235 = __v233 + __v39 * __v234;
    let __v236 = __v231 + __v235;
    let __v237 = __v119 - __v227 + __v1 * __v230;
    let __v238 = __v237 + __v18 * __v227 + (__v40 * __v61 + __v9 * __v230);
    let __v239 = __v238 - __v38 * (__v0 * __v41 + __v1 * __v234);
    let __v240 = __v149 - __v226 + __v2 * __v230;
    let __v241 = __v240 + __v18 * __v226 + (__v42 * __v61 + __v12 * __v230);
    let __v242 = __v241 - __v38 * (__v0 * __v43 + __v2 * __v234);
    let __v243 = __v7 * (__v35 * __v104 + __v14 * __v108);
    let __v244 = __v81 + __v65 * __v104 - __v67 * __v243;
    let __v245 = __v30 * (__v14 * __v102 - __v1 * __v104) + __v82 * __v243;
    let __v246 = __v110 + __v76 * __v104 - __v79 * __v243;
    let __v247 = __v7 * (__v0 * __v244 - __v1 * __v245 + __v2 * __v246);
    let __v248 = __v109 + <S as crate::Scalar>::constant(2.0) * __v104 - __v247;
    let __v249 = __v7 * __v248;
    let __v250 = __v119 - __v244 - __v0 * __v249;
    let __v251 = __v126 + __v31 * __v104 - __v18 * __v244 + __v8 * __v249;
    let __v252 = __v121 + __v122 - (__v41 - __v91 * __v104);
    let __v253 = __v14 * (__v247 - __v248) - __v252;
    let __v254 = __v251 + __v39 * __v253;
    let __v255 = __v250 - __v254;
    let __v256 = __v130 - __v245 + __v1 * __v249;
    let __v257 = __v9 * __v249;
    let __v258 = __v72 + __v131 + __v40 * __v104 + __v18 * __v245 + __v257;
    let __v259 = __v258 + __v50 * __v253;
    let __v260 = __v256 + __v259;
    let __v261 = __v157 - __v246 - __v2 * __v249;
    let __v262 = __v261 + __v18 * __v246 - (__v42 * __v104 + __v12 * __v249);
    let __v263 = __v38 * (__v1 * __v43 + __v2 * __v253) - __v262;
    let __v264 = __v7 * (__v35 * __v135 + __v14 * __v139);
    let __v265 = __v78 - __v65 * __v135 + __v67 * __v264;
    let __v266 = __v30 * (__v14 * __v134 + __v2 * __v135) - __v79 * __v264;
    let __v267 = __v110 - __v80 * __v135 + __v82 * __v264;
    let __v268 = __v7 * (__v2 * __v266 - (__v0 * __v265 + __v1 * __v267));
    let __v269 = __v140 + <S as crate::Scalar>::constant(2.0) * __v135 - __v268;
    let __v270 = __v7 * __v269;
    let __v271 = __v149 - __v265 + __v0 * __v270;
    let __v272 = __v150 - __v31 * __v135 - __v18 * __v265 - __v8 * __v270;
    let __v273 = __v14 * (__v268 - __v269) - (__v43 + (__v91 * __v135 - __v152));
    let __v274 = __v272 - __v39 * __v273;
    let __v275 = __v271 - __v274;
    let __v276 = __v157 - __v267 + __v1 * __v270;
    let __v277 = __v158 - __v40 * __v135 - __v18 * __v267 - __v9 * __v270;
    let __v278 = __v277 - __v50 * __v273;
    let __v279 = __v276 - __v278;
    let __v280 = __v162 - __v266 - __v2 * __v270;
    let __v281 = __v12 * __v270;
    let __v282 = __v72 + __v163 - __v42 * __v135 + __v18 * __v266 - __v281;
    let __v283 = __v282 - __v55 * __v273;
    let __v284 = __v280 + __v283;
    [
        __v25,
        __v49,
        __v54,
        __v59,
        __v48,
        __v53,
        __v58,
        -__v45,
        -__v51,
        -__v56,
        __v99,
        __v128,
        __v133,
        __v156,
        __v160,
        __v165,
        __v180,
        __v182,
        __v184,
        -__v178,
        -__v198,
        -__v202,
        -__v204,
        __v197,
        -__v199,
        -__v216,
        -__v220,
        __v223,
        __v212,
        __v217,
        -__v221,
        __v236,
        -__v239,
        -__v242,
        -__v231,
        __v237,
        __v240,
        -__v235,
        -__v255,
        __v260,
        __v263,
        __v250,
        -__v256,
        __v261,
        -__v254,
        -__v259,
        -__v275,
        -__v279,
        __v284,
        __v271,
        __v276,
        -__v280,
        -__v274,
        -__v278,
        -__v283,
    ]
}

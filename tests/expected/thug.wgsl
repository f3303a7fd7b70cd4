// Aim solver kernels of the rig Thug, derived and written by aim 0.1.0. Do not edit: generate again.
// Pitch turns a joint's forward towards its up, heading towards its left; pitch acts first.
// left_eye: up [1.0, 0.0, 0.0], forward [0.0, 1.0, 0.0], left [0.0, 0.0, 1.0]
// neck: up [1.0, 0.0, 0.0], forward [0.0, 1.0, 0.0], left [0.0, 0.0, 1.0]
// spine3: up [1.0, 0.0, 0.0], forward [0.0, 1.0, 0.0], left [0.0, 0.0, 1.0]
// Lengths are in any one unit, derivatives per radian. Inputs must be finite.

// Aim of joint left_eye, d aim / d pitch, d aim / d heading.
// effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);
// target_point in the joint's space; zeros where it is on the effector.
// 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select.
fn thug_left_eye_aim_gradient(
    effector_to_joint: array<f32, 12>,
    target_point: array<f32, 3>,
    sin_p: f32,
    cos_p: f32,
    sin_h: f32,
    cos_h: f32,
) -> array<f32, 3> {
    let v0 = target_point[1] * cos_h;
    let v1 = target_point[2] * sin_h;
    let v2 = v0 + v1;
    let v3 = sin_p * v2;
    let v4 = target_point[0] * cos_p;
    let v5 = v3 - v4;
    let v6 = effector_to_joint[9] + v5;
    let v7 = v6 * v6;
    let v8 = cos_p * v2;
    let v9 = target_point[0] * sin_p;
    let v10 = v8 + v9;
    let v11 = effector_to_joint[10] - v10;
    let v12 = v11 * v11;
    let v13 = target_point[1] * sin_h;
    let v14 = target_point[2] * cos_h;
    let v15 = v13 - v14;
    let v16 = effector_to_joint[11] + v15;
    let v17 = v16 * v16;
    let v18 = v12 + v17;
    let v19 = v7 + v18;
    let v20 = sqrt(v19);
    let v21 = 1.0f / v20;
    let v22 = select(0.0f, v21, 1.0842022e-19f < v20);
    let v23 = effector_to_joint[3] * v6;
    let v24 = effector_to_joint[4] * v11;
    let v25 = effector_to_joint[5] * v16;
    let v26 = v24 + v25;
    let v27 = v23 + v26;
    let v28 = v22 * v27;
    let v29 = v22 * v28;
    let v30 = v11 * v29;
    let v31 = effector_to_joint[4] - v30;
    let v32 = v5 * v31;
    let v33 = v6 * v29;
    let v34 = effector_to_joint[3] - v33;
    let v35 = v10 * v34;
    let v36 = v32 + v35;
    let v37 = v22 * v36;
    let v38 = cos_p * v31;
    let v39 = sin_p * v34;
    let v40 = v38 - v39;
    let v41 = v15 * v40;
    let v42 = v16 * v29;
    let v43 = effector_to_joint[5] - v42;
    let v44 = v2 * v43;
    let v45 = v41 + v44;
    let v46 = v22 * v45;
    return array<f32, 3>(
        -v28,
        -v37,
        -v46,
    );
}

// Aim of joint neck, d aim / d pitch, d aim / d heading.
// effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);
// target_point in the joint's space; zeros where it is on the effector.
// 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select.
fn thug_neck_aim_gradient(
    effector_to_joint: array<f32, 12>,
    target_point: array<f32, 3>,
    sin_p: f32,
    cos_p: f32,
    sin_h: f32,
    cos_h: f32,
) -> array<f32, 3> {
    let v0 = target_point[1] * cos_h;
    let v1 = target_point[2] * sin_h;
    let v2 = v0 + v1;
    let v3 = sin_p * v2;
    let v4 = target_point[0] * cos_p;
    let v5 = v3 - v4;
    let v6 = effector_to_joint[9] + v5;
    let v7 = v6 * v6;
    let v8 = cos_p * v2;
    let v9 = target_point[0] * sin_p;
    let v10 = v8 + v9;
    let v11 = effector_to_joint[10] - v10;
    let v12 = v11 * v11;
    let v13 = target_point[1] * sin_h;
    let v14 = target_point[2] * cos_h;
    let v15 = v13 - v14;
    let v16 = effector_to_joint[11] + v15;
    let v17 = v16 * v16;
    let v18 = v12 + v17;
    let v19 = v7 + v18;
    let v20 = sqrt(v19);
    let v21 = 1.0f / v20;
    let v22 = select(0.0f, v21, 1.0842022e-19f < v20);
    let v23 = effector_to_joint[3] * v6;
    let v24 = effector_to_joint[4] * v11;
    let v25 = effector_to_joint[5] * v16;
    let v26 = v24 + v25;
    let v27 = v23 + v26;
    let v28 = v22 * v27;
    let v29 = v22 * v28;
    let v30 = v11 * v29;
    let v31 = effector_to_joint[4] - v30;
    let v32 = v5 * v31;
    let v33 = v6 * v29;
    let v34 = effector_to_joint[3] - v33;
    let v35 = v10 * v34;
    let v36 = v32 + v35;
    let v37 = v22 * v36;
    let v38 = cos_p * v31;
    let v39 = sin_p * v34;
    let v40 = v38 - v39;
    let v41 = v15 * v40;
    let v42 = v16 * v29;
    let v43 = effector_to_joint[5] - v42;
    let v44 = v2 * v43;
    let v45 = v41 + v44;
    let v46 = v22 * v45;
    return array<f32, 3>(
        -v28,
        -v37,
        -v46,
    );
}

// Aim of joint spine3, d aim / d pitch, d aim / d heading.
// effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);
// target_point in the joint's space; zeros where it is on the effector.
// 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select.
fn thug_spine3_aim_gradient(
    effector_to_joint: array<f32, 12>,
    target_point: array<f32, 3>,
    sin_p: f32,
    cos_p: f32,
    sin_h: f32,
    cos_h: f32,
) -> array<f32, 3> {
    let v0 = target_point[1] * cos_h;
    let v1 = target_point[2] * sin_h;
    let v2 = v0 + v1;
    let v3 = sin_p * v2;
    let v4 = target_point[0] * cos_p;
    let v5 = v3 - v4;
    let v6 = effector_to_joint[9] + v5;
    let v7 = v6 * v6;
    let v8 = cos_p * v2;
    let v9 = target_point[0] * sin_p;
    let v10 = v8 + v9;
    let v11 = effector_to_joint[10] - v10;
    let v12 = v11 * v11;
    let v13 = target_point[1] * sin_h;
    let v14 = target_point[2] * cos_h;
    let v15 = v13 - v14;
    let v16 = effector_to_joint[11] + v15;
    let v17 = v16 * v16;
    let v18 = v12 + v17;
    let v19 = v7 + v18;
    let v20 = sqrt(v19);
    let v21 = 1.0f / v20;
    let v22 = select(0.0f, v21, 1.0842022e-19f < v20);
    let v23 = effector_to_joint[3] * v6;
    let v24 = effector_to_joint[4] * v11;
    let v25 = effector_to_joint[5] * v16;
    let v26 = v24 + v25;
    let v27 = v23 + v26;
    let v28 = v22 * v27;
    let v29 = v22 * v28;
    let v30 = v11 * v29;
    let v31 = effector_to_joint[4] - v30;
    let v32 = v5 * v31;
    let v33 = v6 * v29;
    let v34 = effector_to_joint[3] - v33;
    let v35 = v10 * v34;
    let v36 = v32 + v35;
    let v37 = v22 * v36;
    let v38 = cos_p * v31;
    let v39 = sin_p * v34;
    let v40 = v38 - v39;
    let v41 = v15 * v40;
    let v42 = v16 * v29;
    let v43 = effector_to_joint[5] - v42;
    let v44 = v2 * v43;
    let v45 = v41 + v44;
    let v46 = v22 * v45;
    return array<f32, 3>(
        -v28,
        -v37,
        -v46,
    );
}

// The chain's aim, then its 6 derivatives, pitch before heading, joint by joint.
// links: effector to joint 0, then joint i-1 to joint i; target_point in the last joint's space;
// sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.
// 173 operations: 67 add, 104 mul, 1 div, 1 sqrt; 2 select.
fn thug_chain_value_gradient(
    links: array<f32, 36>,
    target_point: array<f32, 3>,
    sin_cos: array<f32, 12>,
) -> array<f32, 7> {
    let v0 = target_point[1] * sin_cos[10];
    let v1 = target_point[2] * sin_cos[11];
    let v2 = v0 - v1;
    let v3 = links[35] + v2;
    let v4 = links[29] * v3;
    let v5 = target_point[1] * sin_cos[11];
    let v6 = target_point[2] * sin_cos[10];
    let v7 = v5 + v6;
    let v8 = sin_cos[8] * v7;
    let v9 = target_point[0] * sin_cos[9];
    let v10 = v8 - v9;
    let v11 = links[33] + v10;
    let v12 = links[27] * v11;
    let v13 = sin_cos[9] * v7;
    let v14 = target_point[0] * sin_cos[8];
    let v15 = v13 + v14;
    let v16 = links[34] - v15;
    let v17 = links[28] * v16;
    let v18 = v12 + v17;
    let v19 = v4 + v18;
    let v20 = sin_cos[6] * v19;
    let v21 = links[32] * v3;
    let v22 = links[30] * v11;
    let v23 = links[31] * v16;
    let v24 = v22 + v23;
    let v25 = v21 + v24;
    let v26 = sin_cos[7] * v25;
    let v27 = v20 - v26;
    let v28 = links[23] - v27;
    let v29 = links[17] * v28;
    let v30 = sin_cos[7] * v19;
    let v31 = sin_cos[6] * v25;
    let v32 = v30 + v31;
    let v33 = sin_cos[4] * v32;
    let v34 = links[26] * v3;
    let v35 = links[24] * v11;
    let v36 = links[25] * v16;
    let v37 = v35 + v36;
    let v38 = v34 + v37;
    let v39 = sin_cos[5] * v38;
    let v40 = v33 - v39;
    let v41 = links[21] - v40;
    let v42 = links[15] * v41;
    let v43 = sin_cos[5] * v32;
    let v44 = sin_cos[4] * v38;
    let v45 = v43 + v44;
    let v46 = links[22] + v45;
    let v47 = links[16] * v46;
    let v48 = v42 + v47;
    let v49 = v29 + v48;
    let v50 = sin_cos[3] * v49;
    let v51 = links[20] * v28;
    let v52 = links[18] * v41;
    let v53 = links[19] * v46;
    let v54 = v52 + v53;
    let v55 = v51 + v54;
    let v56 = sin_cos[2] * v55;
    let v57 = v50 + v56;
    let v58 = sin_cos[0] * v57;
    let v59 = links[14] * v28;
    let v60 = links[12] * v41;
    let v61 = links[13] * v46;
    let v62 = v60 + v61;
    let v63 = v59 + v62;
    let v64 = sin_cos[1] * v63;
    let v65 = v58 - v64;
    let v66 = links[9] - v65;
    let v67 = v66 * v66;
    let v68 = sin_cos[1] * v57;
    let v69 = sin_cos[0] * v63;
    let v70 = v68 + v69;
    let v71 = links[10] + v70;
    let v72 = v71 * v71;
    let v73 = sin_cos[2] * v49;
    let v74 = sin_cos[3] * v55;
    let v75 = v73 - v74;
    let v76 = links[11] - v75;
    let v77 = v76 * v76;
    let v78 = v72 + v77;
    let v79 = v67 + v78;
    let v80 = sqrt(v79);
    let v81 = 1.0f / v80;
    let v82 = select(0.0f, v81, 1.0842022e-19f < v80);
    let v83 = links[3] * v66;
    let v84 = links[4] * v71;
    let v85 = links[5] * v76;
    let v86 = v84 + v85;
    let v87 = v83 + v86;
    let v88 = v82 * v87;
    let v89 = v82 * v88;
    let v90 = v71 * v89;
    let v91 = links[4] - v90;
    let v92 = v82 * v91;
    let v93 = v65 * v92;
    let v94 = v66 * v89;
    let v95 = links[3] - v94;
    let v96 = v82 * v95;
    let v97 = v70 * v96;
    let v98 = v93 + v97;
    let v99 = sin_cos[1] * v92;
    let v100 = sin_cos[0] * v96;
    let v101 = v99 - v100;
    let v102 = v75 * v101;
    let v103 = v76 * v89;
    let v104 = links[5] - v103;
    let v105 = v82 * v104;
    let v106 = v57 * v105;
    let v107 = v102 + v106;
    let v108 = sin_cos[2] * v101;
    let v109 = sin_cos[3] * v105;
    let v110 = v108 + v109;
    let v111 = links[19] * v110;
    let v112 = sin_cos[0] * v92;
    let v113 = sin_cos[1] * v96;
    let v114 = v112 + v113;
    let v115 = links[13] * v114;
    let v116 = sin_cos[3] * v101;
    let v117 = sin_cos[2] * v105;
    let v118 = v116 - v117;
    let v119 = links[16] * v118;
    let v120 = v115 + v119;
    let v121 = v111 + v120;
    let v122 = v40 * v121;
    let v123 = links[18] * v110;
    let v124 = links[12] * v114;
    let v125 = links[15] * v118;
    let v126 = v124 + v125;
    let v127 = v123 + v126;
    let v128 = v45 * v127;
    let v129 = v122 + v128;
    let v130 = sin_cos[5] * v121;
    let v131 = sin_cos[4] * v127;
    let v132 = v130 - v131;
    let v133 = v27 * v132;
    let v134 = links[20] * v110;
    let v135 = links[14] * v114;
    let v136 = links[17] * v118;
    let v137 = v135 + v136;
    let v138 = v134 + v137;
    let v139 = v32 * v138;
    let v140 = v133 + v139;
    let v141 = sin_cos[6] * v132;
    let v142 = sin_cos[7] * v138;
    let v143 = v141 + v142;
    let v144 = links[31] * v143;
    let v145 = sin_cos[4] * v121;
    let v146 = sin_cos[5] * v127;
    let v147 = v145 + v146;
    let v148 = links[25] * v147;
    let v149 = sin_cos[7] * v132;
    let v150 = sin_cos[6] * v138;
    let v151 = v149 - v150;
    let v152 = links[28] * v151;
    let v153 = v148 + v152;
    let v154 = v144 + v153;
    let v155 = v10 * v154;
    let v156 = links[30] * v143;
    let v157 = links[24] * v147;
    let v158 = links[27] * v151;
    let v159 = v157 + v158;
    let v160 = v156 + v159;
    let v161 = v15 * v160;
    let v162 = v155 + v161;
    let v163 = sin_cos[9] * v154;
    let v164 = sin_cos[8] * v160;
    let v165 = v163 - v164;
    let v166 = v2 * v165;
    let v167 = links[32] * v143;
    let v168 = links[26] * v147;
    let v169 = links[29] * v151;
    let v170 = v168 + v169;
    let v171 = v167 + v170;
    let v172 = v7 * v171;
    let v173 = v166 + v172;
    return array<f32, 7>(
        -v88,
        v98,
        v107,
        v129,
        v140,
        -v162,
        -v173,
    );
}

// The chain's stereographic residual (left, up), then the 6 derivatives of the first and of the second.
// links: effector to joint 0, then joint i-1 to joint i; target_point in the last joint's space;
// sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.
// 289 operations: 108 add, 178 mul, 2 div, 1 sqrt; 4 select.
fn thug_chain_residual_jacobian(
    links: array<f32, 36>,
    target_point: array<f32, 3>,
    sin_cos: array<f32, 12>,
) -> array<f32, 14> {
    let v0 = target_point[1] * sin_cos[10];
    let v1 = target_point[2] * sin_cos[11];
    let v2 = v0 - v1;
    let v3 = links[35] + v2;
    let v4 = links[29] * v3;
    let v5 = target_point[1] * sin_cos[11];
    let v6 = target_point[2] * sin_cos[10];
    let v7 = v5 + v6;
    let v8 = sin_cos[8] * v7;
    let v9 = target_point[0] * sin_cos[9];
    let v10 = v8 - v9;
    let v11 = links[33] + v10;
    let v12 = links[27] * v11;
    let v13 = sin_cos[9] * v7;
    let v14 = target_point[0] * sin_cos[8];
    let v15 = v13 + v14;
    let v16 = links[34] - v15;
    let v17 = links[28] * v16;
    let v18 = v12 + v17;
    let v19 = v4 + v18;
    let v20 = sin_cos[6] * v19;
    let v21 = links[32] * v3;
    let v22 = links[30] * v11;
    let v23 = links[31] * v16;
    let v24 = v22 + v23;
    let v25 = v21 + v24;
    let v26 = sin_cos[7] * v25;
    let v27 = v20 - v26;
    let v28 = links[23] - v27;
    let v29 = links[17] * v28;
    let v30 = sin_cos[7] * v19;
    let v31 = sin_cos[6] * v25;
    let v32 = v30 + v31;
    let v33 = sin_cos[4] * v32;
    let v34 = links[26] * v3;
    let v35 = links[24] * v11;
    let v36 = links[25] * v16;
    let v37 = v35 + v36;
    let v38 = v34 + v37;
    let v39 = sin_cos[5] * v38;
    let v40 = v33 - v39;
    let v41 = links[21] - v40;
    let v42 = links[15] * v41;
    let v43 = sin_cos[5] * v32;
    let v44 = sin_cos[4] * v38;
    let v45 = v43 + v44;
    let v46 = links[22] + v45;
    let v47 = links[16] * v46;
    let v48 = v42 + v47;
    let v49 = v29 + v48;
    let v50 = sin_cos[3] * v49;
    let v51 = links[20] * v28;
    let v52 = links[18] * v41;
    let v53 = links[19] * v46;
    let v54 = v52 + v53;
    let v55 = v51 + v54;
    let v56 = sin_cos[2] * v55;
    let v57 = v50 + v56;
    let v58 = sin_cos[0] * v57;
    let v59 = links[14] * v28;
    let v60 = links[12] * v41;
    let v61 = links[13] * v46;
    let v62 = v60 + v61;
    let v63 = v59 + v62;
    let v64 = sin_cos[1] * v63;
    let v65 = v58 - v64;
    let v66 = links[9] - v65;
    let v67 = v66 * v66;
    let v68 = sin_cos[1] * v57;
    let v69 = sin_cos[0] * v63;
    let v70 = v68 + v69;
    let v71 = links[10] + v70;
    let v72 = v71 * v71;
    let v73 = sin_cos[2] * v49;
    let v74 = sin_cos[3] * v55;
    let v75 = v73 - v74;
    let v76 = links[11] - v75;
    let v77 = v76 * v76;
    let v78 = v72 + v77;
    let v79 = v67 + v78;
    let v80 = sqrt(v79);
    let v81 = links[5] * v76;
    let v82 = links[3] * v66;
    let v83 = links[4] * v71;
    let v84 = v82 + v83;
    let v85 = v81 + v84;
    let v86 = v80 - v85;
    let v87 = 1.0f / v86;
    let v88 = select(0.0f, v87, 1.0842022e-19f < v86);
    let v89 = 2.0f * v88;
    let v90 = links[8] * v76;
    let v91 = links[6] * v66;
    let v92 = links[7] * v71;
    let v93 = v91 + v92;
    let v94 = v90 + v93;
    let v95 = v89 * v94;
    let v96 = links[2] * v76;
    let v97 = links[0] * v66;
    let v98 = links[1] * v71;
    let v99 = v97 + v98;
    let v100 = v96 + v99;
    let v101 = v89 * v100;
    let v102 = links[7] * v89;
    let v103 = 2.0f * v94;
    let v104 = v88 * v88;
    let v105 = v103 * v104;
    let v106 = links[4] * v105;
    let v107 = v102 + v106;
    let v108 = 1.0f / v80;
    let v109 = select(0.0f, v108, 1.0842022e-19f < v80);
    let v110 = v105 * v109;
    let v111 = v71 * v110;
    let v112 = v107 - v111;
    let v113 = v65 * v112;
    let v114 = links[6] * v89;
    let v115 = links[3] * v105;
    let v116 = v114 + v115;
    let v117 = v66 * v110;
    let v118 = v116 - v117;
    let v119 = v70 * v118;
    let v120 = v113 + v119;
    let v121 = sin_cos[1] * v112;
    let v122 = sin_cos[0] * v118;
    let v123 = v121 - v122;
    let v124 = v75 * v123;
    let v125 = links[8] * v89;
    let v126 = links[5] * v105;
    let v127 = v125 + v126;
    let v128 = v76 * v110;
    let v129 = v127 - v128;
    let v130 = v57 * v129;
    let v131 = v124 + v130;
    let v132 = sin_cos[2] * v123;
    let v133 = sin_cos[3] * v129;
    let v134 = v132 + v133;
    let v135 = links[19] * v134;
    let v136 = sin_cos[0] * v112;
    let v137 = sin_cos[1] * v118;
    let v138 = v136 + v137;
    let v139 = links[13] * v138;
    let v140 = sin_cos[3] * v123;
    let v141 = sin_cos[2] * v129;
    let v142 = v140 - v141;
    let v143 = links[16] * v142;
    let v144 = v139 + v143;
    let v145 = v135 + v144;
    let v146 = v40 * v145;
    let v147 = links[18] * v134;
    let v148 = links[12] * v138;
    let v149 = links[15] * v142;
    let v150 = v148 + v149;
    let v151 = v147 + v150;
    let v152 = v45 * v151;
    let v153 = v146 + v152;
    let v154 = sin_cos[5] * v145;
    let v155 = sin_cos[4] * v151;
    let v156 = v154 - v155;
    let v157 = v27 * v156;
    let v158 = links[20] * v134;
    let v159 = links[14] * v138;
    let v160 = links[17] * v142;
    let v161 = v159 + v160;
    let v162 = v158 + v161;
    let v163 = v32 * v162;
    let v164 = v157 + v163;
    let v165 = sin_cos[6] * v156;
    let v166 = sin_cos[7] * v162;
    let v167 = v165 + v166;
    let v168 = links[31] * v167;
    let v169 = sin_cos[4] * v145;
    let v170 = sin_cos[5] * v151;
    let v171 = v169 + v170;
    let v172 = links[25] * v171;
    let v173 = sin_cos[7] * v156;
    let v174 = sin_cos[6] * v162;
    let v175 = v173 - v174;
    let v176 = links[28] * v175;
    let v177 = v172 + v176;
    let v178 = v168 + v177;
    let v179 = v10 * v178;
    let v180 = links[30] * v167;
    let v181 = links[24] * v171;
    let v182 = links[27] * v175;
    let v183 = v181 + v182;
    let v184 = v180 + v183;
    let v185 = v15 * v184;
    let v186 = v179 + v185;
    let v187 = sin_cos[9] * v178;
    let v188 = sin_cos[8] * v184;
    let v189 = v187 - v188;
    let v190 = v2 * v189;
    let v191 = links[32] * v167;
    let v192 = links[26] * v171;
    let v193 = links[29] * v175;
    let v194 = v192 + v193;
    let v195 = v191 + v194;
    let v196 = v7 * v195;
    let v197 = v190 + v196;
    let v198 = links[1] * v89;
    let v199 = 2.0f * v100;
    let v200 = v104 * v199;
    let v201 = links[4] * v200;
    let v202 = v198 + v201;
    let v203 = v109 * v200;
    let v204 = v71 * v203;
    let v205 = v202 - v204;
    let v206 = v65 * v205;
    let v207 = links[0] * v89;
    let v208 = links[3] * v200;
    let v209 = v207 + v208;
    let v210 = v66 * v203;
    let v211 = v209 - v210;
    let v212 = v70 * v211;
    let v213 = v206 + v212;
    let v214 = sin_cos[1] * v205;
    let v215 = sin_cos[0] * v211;
    let v216 = v214 - v215;
    let v217 = v75 * v216;
    let v218 = links[2] * v89;
    let v219 = links[5] * v200;
    let v220 = v218 + v219;
    let v221 = v76 * v203;
    let v222 = v220 - v221;
    let v223 = v57 * v222;
    let v224 = v217 + v223;
    let v225 = sin_cos[2] * v216;
    let v226 = sin_cos[3] * v222;
    let v227 = v225 + v226;
    let v228 = links[19] * v227;
    let v229 = sin_cos[0] * v205;
    let v230 = sin_cos[1] * v211;
    let v231 = v229 + v230;
    let v232 = links[13] * v231;
    let v233 = sin_cos[3] * v216;
    let v234 = sin_cos[2] * v222;
    let v235 = v233 - v234;
    let v236 = links[16] * v235;
    let v237 = v232 + v236;
    let v238 = v228 + v237;
    let v239 = v40 * v238;
    let v240 = links[18] * v227;
    let v241 = links[12] * v231;
    let v242 = links[15] * v235;
    let v243 = v241 + v242;
    let v244 = v240 + v243;
    let v245 = v45 * v244;
    let v246 = v239 + v245;
    let v247 = sin_cos[5] * v238;
    let v248 = sin_cos[4] * v244;
    let v249 = v247 - v248;
    let v250 = v27 * v249;
    let v251 = links[20] * v227;
    let v252 = links[14] * v231;
    let v253 = links[17] * v235;
    let v254 = v252 + v253;
    let v255 = v251 + v254;
    let v256 = v32 * v255;
    let v257 = v250 + v256;
    let v258 = sin_cos[6] * v249;
    let v259 = sin_cos[7] * v255;
    let v260 = v258 + v259;
    let v261 = links[31] * v260;
    let v262 = sin_cos[4] * v238;
    let v263 = sin_cos[5] * v244;
    let v264 = v262 + v263;
    let v265 = links[25] * v264;
    let v266 = sin_cos[7] * v249;
    let v267 = sin_cos[6] * v255;
    let v268 = v266 - v267;
    let v269 = links[28] * v268;
    let v270 = v265 + v269;
    let v271 = v261 + v270;
    let v272 = v10 * v271;
    let v273 = links[30] * v260;
    let v274 = links[24] * v264;
    let v275 = links[27] * v268;
    let v276 = v274 + v275;
    let v277 = v273 + v276;
    let v278 = v15 * v277;
    let v279 = v272 + v278;
    let v280 = sin_cos[9] * v271;
    let v281 = sin_cos[8] * v277;
    let v282 = v280 - v281;
    let v283 = v2 * v282;
    let v284 = links[32] * v260;
    let v285 = links[26] * v264;
    let v286 = links[29] * v268;
    let v287 = v285 + v286;
    let v288 = v284 + v287;
    let v289 = v7 * v288;
    let v290 = v283 + v289;
    return array<f32, 14>(
        -v95,
        -v101,
        v120,
        v131,
        v153,
        v164,
        -v186,
        -v197,
        v213,
        v224,
        v246,
        v257,
        -v279,
        -v290,
    );
}

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
    let v0 = target_point[1] * cos_h + target_point[2] * sin_h;
    let v1 = target_point[0] * cos_p - sin_p * v0;
    let v2 = v1 - effector_to_joint[9];
    let v3 = cos_p * v0 + target_point[0] * sin_p;
    let v4 = v3 - effector_to_joint[10];
    let v5 = target_point[2] * cos_h - target_point[1] * sin_h;
    let v6 = v5 - effector_to_joint[11];
    let v7 = v2 * v2 + v4 * v4 + v6 * v6;
    let v8 = sqrt(v7);
    let v9 = 1.0f / v8;
    let v10 = select(0.0f, v9, 1.0842022e-19f < v8);
    let v11 = v10 * (effector_to_joint[3] * v2 + effector_to_joint[4] * v4 + effector_to_joint[5] * v6);
    let v12 = v10 * v11;
    let v13 = effector_to_joint[4] - v4 * v12;
    let v14 = effector_to_joint[3] - v2 * v12;
    let v15 = v10 * (v1 * v13 - v3 * v14);
    let v16 = v0 * (effector_to_joint[5] - v6 * v12);
    let v17 = v10 * (v5 * (cos_p * v13 - sin_p * v14) - v16);
    return array<f32, 3>(
        v11,
        v15,
        v17,
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
    let v0 = target_point[1] * cos_h + target_point[2] * sin_h;
    let v1 = target_point[0] * cos_p - sin_p * v0;
    let v2 = v1 - effector_to_joint[9];
    let v3 = cos_p * v0 + target_point[0] * sin_p;
    let v4 = v3 - effector_to_joint[10];
    let v5 = target_point[2] * cos_h - target_point[1] * sin_h;
    let v6 = v5 - effector_to_joint[11];
    let v7 = v2 * v2 + v4 * v4 + v6 * v6;
    let v8 = sqrt(v7);
    let v9 = 1.0f / v8;
    let v10 = select(0.0f, v9, 1.0842022e-19f < v8);
    let v11 = v10 * (effector_to_joint[3] * v2 + effector_to_joint[4] * v4 + effector_to_joint[5] * v6);
    let v12 = v10 * v11;
    let v13 = effector_to_joint[4] - v4 * v12;
    let v14 = effector_to_joint[3] - v2 * v12;
    let v15 = v10 * (v1 * v13 - v3 * v14);
    let v16 = v0 * (effector_to_joint[5] - v6 * v12);
    let v17 = v10 * (v5 * (cos_p * v13 - sin_p * v14) - v16);
    return array<f32, 3>(
        v11,
        v15,
        v17,
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
    let v0 = target_point[1] * cos_h + target_point[2] * sin_h;
    let v1 = target_point[0] * cos_p - sin_p * v0;
    let v2 = v1 - effector_to_joint[9];
    let v3 = cos_p * v0 + target_point[0] * sin_p;
    let v4 = v3 - effector_to_joint[10];
    let v5 = target_point[2] * cos_h - target_point[1] * sin_h;
    let v6 = v5 - effector_to_joint[11];
    let v7 = v2 * v2 + v4 * v4 + v6 * v6;
    let v8 = sqrt(v7);
    let v9 = 1.0f / v8;
    let v10 = select(0.0f, v9, 1.0842022e-19f < v8);
    let v11 = v10 * (effector_to_joint[3] * v2 + effector_to_joint[4] * v4 + effector_to_joint[5] * v6);
    let v12 = v10 * v11;
    let v13 = effector_to_joint[4] - v4 * v12;
    let v14 = effector_to_joint[3] - v2 * v12;
    let v15 = v10 * (v1 * v13 - v3 * v14);
    let v16 = v0 * (effector_to_joint[5] - v6 * v12);
    let v17 = v10 * (v5 * (cos_p * v13 - sin_p * v14) - v16);
    return array<f32, 3>(
        v11,
        v15,
        v17,
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
    let v0 = target_point[1] * sin_cos[11] + target_point[2] * sin_cos[10];
    let v1 = sin_cos[8] * v0 - target_point[0] * sin_cos[9];
    let v2 = v1 + links[33];
    let v3 = sin_cos[9] * v0 + target_point[0] * sin_cos[8];
    let v4 = links[34] - v3;
    let v5 = target_point[1] * sin_cos[10] - target_point[2] * sin_cos[11];
    let v6 = v5 + links[35];
    let v7 = links[27] * v2 + links[28] * v4 + links[29] * v6;
    let v8 = links[30] * v2 + links[31] * v4 + links[32] * v6;
    let v9 = sin_cos[7] * v7 + sin_cos[6] * v8;
    let v10 = links[24] * v2 + links[25] * v4 + links[26] * v6;
    let v11 = sin_cos[4] * v9 - sin_cos[5] * v10;
    let v12 = links[21] - v11;
    let v13 = sin_cos[5] * v9 + sin_cos[4] * v10;
    let v14 = v13 + links[22];
    let v15 = sin_cos[6] * v7 - sin_cos[7] * v8;
    let v16 = links[23] - v15;
    let v17 = links[15] * v12 + links[16] * v14 + links[17] * v16;
    let v18 = links[18] * v12 + links[19] * v14 + links[20] * v16;
    let v19 = sin_cos[3] * v17 + sin_cos[2] * v18;
    let v20 = links[12] * v12 + links[13] * v14 + links[14] * v16;
    let v21 = sin_cos[0] * v19 - sin_cos[1] * v20;
    let v22 = links[9] - v21;
    let v23 = sin_cos[1] * v19 + sin_cos[0] * v20;
    let v24 = v23 + links[10];
    let v25 = sin_cos[2] * v17 - sin_cos[3] * v18;
    let v26 = links[11] - v25;
    let v27 = v22 * v22 + v24 * v24 + v26 * v26;
    let v28 = sqrt(v27);
    let v29 = 1.0f / v28;
    let v30 = select(0.0f, v29, 1.0842022e-19f < v28);
    let v31 = v30 * (links[3] * v22 + links[4] * v24 + links[5] * v26);
    let v32 = v30 * v31;
    let v33 = v30 * (links[4] - v24 * v32);
    let v34 = v30 * (links[3] - v22 * v32);
    let v35 = v21 * v33 + v23 * v34;
    let v36 = sin_cos[1] * v33 - sin_cos[0] * v34;
    let v37 = v30 * (links[5] - v26 * v32);
    let v38 = v25 * v36 + v19 * v37;
    let v39 = sin_cos[0] * v33 + sin_cos[1] * v34;
    let v40 = sin_cos[3] * v36 - sin_cos[2] * v37;
    let v41 = sin_cos[2] * v36 + sin_cos[3] * v37;
    let v42 = links[13] * v39 + links[16] * v40 + links[19] * v41;
    let v43 = links[12] * v39 + links[15] * v40 + links[18] * v41;
    let v44 = v11 * v42 + v13 * v43;
    let v45 = sin_cos[5] * v42 - sin_cos[4] * v43;
    let v46 = links[14] * v39 + links[17] * v40 + links[20] * v41;
    let v47 = v15 * v45 + v9 * v46;
    let v48 = sin_cos[4] * v42 + sin_cos[5] * v43;
    let v49 = sin_cos[7] * v45 - sin_cos[6] * v46;
    let v50 = sin_cos[6] * v45 + sin_cos[7] * v46;
    let v51 = links[25] * v48 + links[28] * v49 + links[31] * v50;
    let v52 = links[24] * v48 + links[27] * v49 + links[30] * v50;
    let v53 = v1 * v51 + v3 * v52;
    let v54 = v0 * (links[26] * v48 + links[29] * v49 + links[32] * v50);
    let v55 = v5 * (sin_cos[9] * v51 - sin_cos[8] * v52) + v54;
    return array<f32, 7>(
        -v31,
        v35,
        v38,
        v44,
        v47,
        -v53,
        -v55,
    );
}

// The chain's stereographic residual (left, up), then the 6 derivatives of the first and of the second.
// links: effector to joint 0, then joint i-1 to joint i; target_point in the last joint's space;
// sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.
// 279 operations: 105 add, 171 mul, 2 div, 1 sqrt; 4 select.
fn thug_chain_residual_jacobian(
    links: array<f32, 36>,
    target_point: array<f32, 3>,
    sin_cos: array<f32, 12>,
) -> array<f32, 14> {
    let v0 = target_point[1] * sin_cos[11] + target_point[2] * sin_cos[10];
    let v1 = sin_cos[8] * v0 - target_point[0] * sin_cos[9];
    let v2 = v1 + links[33];
    let v3 = sin_cos[9] * v0 + target_point[0] * sin_cos[8];
    let v4 = links[34] - v3;
    let v5 = target_point[1] * sin_cos[10] - target_point[2] * sin_cos[11];
    let v6 = v5 + links[35];
    let v7 = links[27] * v2 + links[28] * v4 + links[29] * v6;
    let v8 = links[30] * v2 + links[31] * v4 + links[32] * v6;
    let v9 = sin_cos[7] * v7 + sin_cos[6] * v8;
    let v10 = links[24] * v2 + links[25] * v4 + links[26] * v6;
    let v11 = sin_cos[4] * v9 - sin_cos[5] * v10;
    let v12 = links[21] - v11;
    let v13 = sin_cos[5] * v9 + sin_cos[4] * v10;
    let v14 = v13 + links[22];
    let v15 = sin_cos[6] * v7 - sin_cos[7] * v8;
    let v16 = links[23] - v15;
    let v17 = links[15] * v12 + links[16] * v14 + links[17] * v16;
    let v18 = links[18] * v12 + links[19] * v14 + links[20] * v16;
    let v19 = sin_cos[3] * v17 + sin_cos[2] * v18;
    let v20 = links[12] * v12 + links[13] * v14 + links[14] * v16;
    let v21 = sin_cos[1] * v19 + sin_cos[0] * v20;
    let v22 = v21 + links[10];
    let v23 = sin_cos[2] * v17 - sin_cos[3] * v18;
    let v24 = links[11] - v23;
    let v25 = sin_cos[0] * v19 - sin_cos[1] * v20;
    let v26 = links[9] - v25;
    let v27 = v22 * v22 + v24 * v24 + v26 * v26;
    let v28 = sqrt(v27);
    let v29 = v28 - (links[3] * v26 + links[4] * v22 + links[5] * v24);
    let v30 = 1.0f / v29;
    let v31 = select(0.0f, v30, 1.0842022e-19f < v29);
    let v32 = 2.0f * v31;
    let v33 = links[6] * v26 + links[7] * v22 + links[8] * v24;
    let v34 = v32 * v33;
    let v35 = links[0] * v26 + links[1] * v22 + links[2] * v24;
    let v36 = v32 * v35;
    let v37 = 1.0f / v28;
    let v38 = select(0.0f, v37, 1.0842022e-19f < v28);
    let v39 = links[4] - v22 * v38;
    let v40 = v31 * v32;
    let v41 = v33 * v40;
    let v42 = links[7] * v32 + v39 * v41;
    let v43 = links[3] - v26 * v38;
    let v44 = links[6] * v32 + v43 * v41;
    let v45 = v25 * v42 + v21 * v44;
    let v46 = sin_cos[1] * v42 - sin_cos[0] * v44;
    let v47 = links[5] - v24 * v38;
    let v48 = links[8] * v32 + v47 * v41;
    let v49 = v23 * v46 + v19 * v48;
    let v50 = sin_cos[0] * v42 + sin_cos[1] * v44;
    let v51 = sin_cos[3] * v46 - sin_cos[2] * v48;
    let v52 = sin_cos[2] * v46 + sin_cos[3] * v48;
    let v53 = links[13] * v50 + links[16] * v51 + links[19] * v52;
    let v54 = links[12] * v50 + links[15] * v51 + links[18] * v52;
    let v55 = v11 * v53 + v13 * v54;
    let v56 = sin_cos[5] * v53 - sin_cos[4] * v54;
    let v57 = links[14] * v50 + links[17] * v51 + links[20] * v52;
    let v58 = v15 * v56 + v9 * v57;
    let v59 = sin_cos[4] * v53 + sin_cos[5] * v54;
    let v60 = sin_cos[7] * v56 - sin_cos[6] * v57;
    let v61 = sin_cos[6] * v56 + sin_cos[7] * v57;
    let v62 = links[25] * v59 + links[28] * v60 + links[31] * v61;
    let v63 = links[24] * v59 + links[27] * v60 + links[30] * v61;
    let v64 = v1 * v62 + v3 * v63;
    let v65 = v0 * (links[26] * v59 + links[29] * v60 + links[32] * v61);
    let v66 = v5 * (sin_cos[9] * v62 - sin_cos[8] * v63) + v65;
    let v67 = v35 * v40;
    let v68 = links[1] * v32 + v39 * v67;
    let v69 = links[0] * v32 + v43 * v67;
    let v70 = v25 * v68 + v21 * v69;
    let v71 = sin_cos[1] * v68 - sin_cos[0] * v69;
    let v72 = links[2] * v32 + v47 * v67;
    let v73 = v23 * v71 + v19 * v72;
    let v74 = sin_cos[0] * v68 + sin_cos[1] * v69;
    let v75 = sin_cos[3] * v71 - sin_cos[2] * v72;
    let v76 = sin_cos[2] * v71 + sin_cos[3] * v72;
    let v77 = links[13] * v74 + links[16] * v75 + links[19] * v76;
    let v78 = links[12] * v74 + links[15] * v75 + links[18] * v76;
    let v79 = v11 * v77 + v13 * v78;
    let v80 = sin_cos[5] * v77 - sin_cos[4] * v78;
    let v81 = links[14] * v74 + links[17] * v75 + links[20] * v76;
    let v82 = v15 * v80 + v9 * v81;
    let v83 = sin_cos[4] * v77 + sin_cos[5] * v78;
    let v84 = sin_cos[7] * v80 - sin_cos[6] * v81;
    let v85 = sin_cos[6] * v80 + sin_cos[7] * v81;
    let v86 = links[25] * v83 + links[28] * v84 + links[31] * v85;
    let v87 = links[24] * v83 + links[27] * v84 + links[30] * v85;
    let v88 = v1 * v86 + v3 * v87;
    let v89 = v0 * (links[26] * v83 + links[29] * v84 + links[32] * v85);
    let v90 = v5 * (sin_cos[9] * v86 - sin_cos[8] * v87) + v89;
    return array<f32, 14>(
        -v34,
        -v36,
        v45,
        v49,
        v55,
        v58,
        -v64,
        -v66,
        v70,
        v73,
        v79,
        v82,
        -v88,
        -v90,
    );
}

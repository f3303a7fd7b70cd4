/* Aim solver kernels of the rig Thug, derived and written by aim 0.1.0. Do not edit: generate again.
 * Pitch turns a joint's forward towards its up, heading towards its left; pitch acts first.
 * left_eye: up [1.0, 0.0, 0.0], forward [0.0, 1.0, 0.0], left [0.0, 0.0, 1.0]
 * neck: up [1.0, 0.0, 0.0], forward [0.0, 1.0, 0.0], left [0.0, 0.0, 1.0]
 * spine3: up [1.0, 0.0, 0.0], forward [0.0, 1.0, 0.0], left [0.0, 0.0, 1.0]
 * Inputs must be finite. The same bits as in Rust come of compiling without contraction (-ffp-contract=off). */
#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Aim of joint left_eye, d aim / d pitch, d aim / d heading.
 * effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);
 * target in the joint's space; zeros where it is on the effector.
 * 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. */
void thug_left_eye_aim_gradient(const float effector_to_joint[12], const float target[3],
    float sin_p, float cos_p, float sin_h, float cos_h, float out[3])
{
    (void)effector_to_joint;
    (void)target;
    (void)sin_p;
    (void)cos_p;
    (void)sin_h;
    (void)cos_h;
    const float v0 = target[1] * cos_h + target[2] * sin_h;
    const float v1 = target[0] * cos_p - sin_p * v0;
    const float v2 = v1 - effector_to_joint[9];
    const float v3 = cos_p * v0 + target[0] * sin_p;
    const float v4 = v3 - effector_to_joint[10];
    const float v5 = target[2] * cos_h - target[1] * sin_h;
    const float v6 = v5 - effector_to_joint[11];
    const float v7 = v2 * v2 + v4 * v4 + v6 * v6;
    const float v8 = sqrtf(v7);
    const float v9 = 1.0f / v8;
    const float v10 = 1.0842022e-19f < v8 ? v9 : 0.0f;
    const float v11 = v10 * (effector_to_joint[3] * v2 + effector_to_joint[4] * v4 + effector_to_joint[5] * v6);
    const float v12 = v10 * v11;
    const float v13 = effector_to_joint[4] - v4 * v12;
    const float v14 = effector_to_joint[3] - v2 * v12;
    const float v15 = v10 * (v1 * v13 - v3 * v14);
    const float v16 = v0 * (effector_to_joint[5] - v6 * v12);
    const float v17 = v10 * (v5 * (cos_p * v13 - sin_p * v14) - v16);
    out[0] = v11;
    out[1] = v15;
    out[2] = v17;
}

/* Aim of joint neck, d aim / d pitch, d aim / d heading.
 * effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);
 * target in the joint's space; zeros where it is on the effector.
 * 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. */
void thug_neck_aim_gradient(const float effector_to_joint[12], const float target[3],
    float sin_p, float cos_p, float sin_h, float cos_h, float out[3])
{
    (void)effector_to_joint;
    (void)target;
    (void)sin_p;
    (void)cos_p;
    (void)sin_h;
    (void)cos_h;
    const float v0 = target[1] * cos_h + target[2] * sin_h;
    const float v1 = target[0] * cos_p - sin_p * v0;
    const float v2 = v1 - effector_to_joint[9];
    const float v3 = cos_p * v0 + target[0] * sin_p;
    const float v4 = v3 - effector_to_joint[10];
    const float v5 = target[2] * cos_h - target[1] * sin_h;
    const float v6 = v5 - effector_to_joint[11];
    const float v7 = v2 * v2 + v4 * v4 + v6 * v6;
    const float v8 = sqrtf(v7);
    const float v9 = 1.0f / v8;
    const float v10 = 1.0842022e-19f < v8 ? v9 : 0.0f;
    const float v11 = v10 * (effector_to_joint[3] * v2 + effector_to_joint[4] * v4 + effector_to_joint[5] * v6);
    const float v12 = v10 * v11;
    const float v13 = effector_to_joint[4] - v4 * v12;
    const float v14 = effector_to_joint[3] - v2 * v12;
    const float v15 = v10 * (v1 * v13 - v3 * v14);
    const float v16 = v0 * (effector_to_joint[5] - v6 * v12);
    const float v17 = v10 * (v5 * (cos_p * v13 - sin_p * v14) - v16);
    out[0] = v11;
    out[1] = v15;
    out[2] = v17;
}

/* Aim of joint spine3, d aim / d pitch, d aim / d heading.
 * effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);
 * target in the joint's space; zeros where it is on the effector.
 * 46 operations: 17 add, 27 mul, 1 div, 1 sqrt; 2 select. */
void thug_spine3_aim_gradient(const float effector_to_joint[12], const float target[3],
    float sin_p, float cos_p, float sin_h, float cos_h, float out[3])
{
    (void)effector_to_joint;
    (void)target;
    (void)sin_p;
    (void)cos_p;
    (void)sin_h;
    (void)cos_h;
    const float v0 = target[1] * cos_h + target[2] * sin_h;
    const float v1 = target[0] * cos_p - sin_p * v0;
    const float v2 = v1 - effector_to_joint[9];
    const float v3 = cos_p * v0 + target[0] * sin_p;
    const float v4 = v3 - effector_to_joint[10];
    const float v5 = target[2] * cos_h - target[1] * sin_h;
    const float v6 = v5 - effector_to_joint[11];
    const float v7 = v2 * v2 + v4 * v4 + v6 * v6;
    const float v8 = sqrtf(v7);
    const float v9 = 1.0f / v8;
    const float v10 = 1.0842022e-19f < v8 ? v9 : 0.0f;
    const float v11 = v10 * (effector_to_joint[3] * v2 + effector_to_joint[4] * v4 + effector_to_joint[5] * v6);
    const float v12 = v10 * v11;
    const float v13 = effector_to_joint[4] - v4 * v12;
    const float v14 = effector_to_joint[3] - v2 * v12;
    const float v15 = v10 * (v1 * v13 - v3 * v14);
    const float v16 = v0 * (effector_to_joint[5] - v6 * v12);
    const float v17 = v10 * (v5 * (cos_p * v13 - sin_p * v14) - v16);
    out[0] = v11;
    out[1] = v15;
    out[2] = v17;
}

/* The chain's aim, then its 6 derivatives, pitch before heading, joint by joint.
 * links: effector to joint 0, then joint i-1 to joint i; target in the last joint's space;
 * sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.
 * 173 operations: 67 add, 104 mul, 1 div, 1 sqrt; 2 select. */
void thug_chain_value_gradient(const float links[36], const float target[3], const float sin_cos[12],
    float out[7])
{
    (void)links;
    (void)target;
    (void)sin_cos;
    const float v0 = target[1] * sin_cos[11] + target[2] * sin_cos[10];
    const float v1 = sin_cos[8] * v0 - target[0] * sin_cos[9];
    const float v2 = v1 + links[33];
    const float v3 = sin_cos[9] * v0 + target[0] * sin_cos[8];
    const float v4 = links[34] - v3;
    const float v5 = target[1] * sin_cos[10] - target[2] * sin_cos[11];
    const float v6 = v5 + links[35];
    const float v7 = links[27] * v2 + links[28] * v4 + links[29] * v6;
    const float v8 = links[30] * v2 + links[31] * v4 + links[32] * v6;
    const float v9 = sin_cos[7] * v7 + sin_cos[6] * v8;
    const float v10 = links[24] * v2 + links[25] * v4 + links[26] * v6;
    const float v11 = sin_cos[4] * v9 - sin_cos[5] * v10;
    const float v12 = links[21] - v11;
    const float v13 = sin_cos[5] * v9 + sin_cos[4] * v10;
    const float v14 = v13 + links[22];
    const float v15 = sin_cos[6] * v7 - sin_cos[7] * v8;
    const float v16 = links[23] - v15;
    const float v17 = links[15] * v12 + links[16] * v14 + links[17] * v16;
    const float v18 = links[18] * v12 + links[19] * v14 + links[20] * v16;
    const float v19 = sin_cos[3] * v17 + sin_cos[2] * v18;
    const float v20 = links[12] * v12 + links[13] * v14 + links[14] * v16;
    const float v21 = sin_cos[0] * v19 - sin_cos[1] * v20;
    const float v22 = links[9] - v21;
    const float v23 = sin_cos[1] * v19 + sin_cos[0] * v20;
    const float v24 = v23 + links[10];
    const float v25 = sin_cos[2] * v17 - sin_cos[3] * v18;
    const float v26 = links[11] - v25;
    const float v27 = v22 * v22 + v24 * v24 + v26 * v26;
    const float v28 = sqrtf(v27);
    const float v29 = 1.0f / v28;
    const float v30 = 1.0842022e-19f < v28 ? v29 : 0.0f;
    const float v31 = v30 * (links[3] * v22 + links[4] * v24 + links[5] * v26);
    const float v32 = v30 * v31;
    const float v33 = v30 * (links[4] - v24 * v32);
    const float v34 = v30 * (links[3] - v22 * v32);
    const float v35 = v21 * v33 + v23 * v34;
    const float v36 = sin_cos[1] * v33 - sin_cos[0] * v34;
    const float v37 = v30 * (links[5] - v26 * v32);
    const float v38 = v25 * v36 + v19 * v37;
    const float v39 = sin_cos[0] * v33 + sin_cos[1] * v34;
    const float v40 = sin_cos[3] * v36 - sin_cos[2] * v37;
    const float v41 = sin_cos[2] * v36 + sin_cos[3] * v37;
    const float v42 = links[13] * v39 + links[16] * v40 + links[19] * v41;
    const float v43 = links[12] * v39 + links[15] * v40 + links[18] * v41;
    const float v44 = v11 * v42 + v13 * v43;
    const float v45 = sin_cos[5] * v42 - sin_cos[4] * v43;
    const float v46 = links[14] * v39 + links[17] * v40 + links[20] * v41;
    const float v47 = v15 * v45 + v9 * v46;
    const float v48 = sin_cos[4] * v42 + sin_cos[5] * v43;
    const float v49 = sin_cos[7] * v45 - sin_cos[6] * v46;
    const float v50 = sin_cos[6] * v45 + sin_cos[7] * v46;
    const float v51 = links[25] * v48 + links[28] * v49 + links[31] * v50;
    const float v52 = links[24] * v48 + links[27] * v49 + links[30] * v50;
    const float v53 = v1 * v51 + v3 * v52;
    const float v54 = v0 * (links[26] * v48 + links[29] * v49 + links[32] * v50);
    const float v55 = v5 * (sin_cos[9] * v51 - sin_cos[8] * v52) + v54;
    out[0] = -v31;
    out[1] = v35;
    out[2] = v38;
    out[3] = v44;
    out[4] = v47;
    out[5] = -v53;
    out[6] = -v55;
}

/* The chain's stereographic residual (left, up), then the 6 derivatives of the first and of the second.
 * links: effector to joint 0, then joint i-1 to joint i; target in the last joint's space;
 * sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.
 * 279 operations: 105 add, 171 mul, 2 div, 1 sqrt; 4 select. */
void thug_chain_residual_jacobian(const float links[36], const float target[3], const float sin_cos[12],
    float out[14])
{
    (void)links;
    (void)target;
    (void)sin_cos;
    const float v0 = target[1] * sin_cos[11] + target[2] * sin_cos[10];
    const float v1 = sin_cos[8] * v0 - target[0] * sin_cos[9];
    const float v2 = v1 + links[33];
    const float v3 = sin_cos[9] * v0 + target[0] * sin_cos[8];
    const float v4 = links[34] - v3;
    const float v5 = target[1] * sin_cos[10] - target[2] * sin_cos[11];
    const float v6 = v5 + links[35];
    const float v7 = links[27] * v2 + links[28] * v4 + links[29] * v6;
    const float v8 = links[30] * v2 + links[31] * v4 + links[32] * v6;
    const float v9 = sin_cos[7] * v7 + sin_cos[6] * v8;
    const float v10 = links[24] * v2 + links[25] * v4 + links[26] * v6;
    const float v11 = sin_cos[4] * v9 - sin_cos[5] * v10;
    const float v12 = links[21] - v11;
    const float v13 = sin_cos[5] * v9 + sin_cos[4] * v10;
    const float v14 = v13 + links[22];
    const float v15 = sin_cos[6] * v7 - sin_cos[7] * v8;
    const float v16 = links[23] - v15;
    const float v17 = links[15] * v12 + links[16] * v14 + links[17] * v16;
    const float v18 = links[18] * v12 + links[19] * v14 + links[20] * v16;
    const float v19 = sin_cos[3] * v17 + sin_cos[2] * v18;
    const float v20 = links[12] * v12 + links[13] * v14 + links[14] * v16;
    const float v21 = sin_cos[1] * v19 + sin_cos[0] * v20;
    const float v22 = v21 + links[10];
    const float v23 = sin_cos[2] * v17 - sin_cos[3] * v18;
    const float v24 = links[11] - v23;
    const float v25 = sin_cos[0] * v19 - sin_cos[1] * v20;
    const float v26 = links[9] - v25;
    const float v27 = v22 * v22 + v24 * v24 + v26 * v26;
    const float v28 = sqrtf(v27);
    const float v29 = v28 - (links[3] * v26 + links[4] * v22 + links[5] * v24);
    const float v30 = 1.0f / v29;
    const float v31 = 1.0842022e-19f < v29 ? v30 : 0.0f;
    const float v32 = 2.0f * v31;
    const float v33 = links[6] * v26 + links[7] * v22 + links[8] * v24;
    const float v34 = v32 * v33;
    const float v35 = links[0] * v26 + links[1] * v22 + links[2] * v24;
    const float v36 = v32 * v35;
    const float v37 = 1.0f / v28;
    const float v38 = 1.0842022e-19f < v28 ? v37 : 0.0f;
    const float v39 = links[4] - v22 * v38;
    const float v40 = v31 * v32;
    const float v41 = v33 * v40;
    const float v42 = links[7] * v32 + v39 * v41;
    const float v43 = links[3] - v26 * v38;
    const float v44 = links[6] * v32 + v43 * v41;
    const float v45 = v25 * v42 + v21 * v44;
    const float v46 = sin_cos[1] * v42 - sin_cos[0] * v44;
    const float v47 = links[5] - v24 * v38;
    const float v48 = links[8] * v32 + v47 * v41;
    const float v49 = v23 * v46 + v19 * v48;
    const float v50 = sin_cos[0] * v42 + sin_cos[1] * v44;
    const float v51 = sin_cos[3] * v46 - sin_cos[2] * v48;
    const float v52 = sin_cos[2] * v46 + sin_cos[3] * v48;
    const float v53 = links[13] * v50 + links[16] * v51 + links[19] * v52;
    const float v54 = links[12] * v50 + links[15] * v51 + links[18] * v52;
    const float v55 = v11 * v53 + v13 * v54;
    const float v56 = sin_cos[5] * v53 - sin_cos[4] * v54;
    const float v57 = links[14] * v50 + links[17] * v51 + links[20] * v52;
    const float v58 = v15 * v56 + v9 * v57;
    const float v59 = sin_cos[4] * v53 + sin_cos[5] * v54;
    const float v60 = sin_cos[7] * v56 - sin_cos[6] * v57;
    const float v61 = sin_cos[6] * v56 + sin_cos[7] * v57;
    const float v62 = links[25] * v59 + links[28] * v60 + links[31] * v61;
    const float v63 = links[24] * v59 + links[27] * v60 + links[30] * v61;
    const float v64 = v1 * v62 + v3 * v63;
    const float v65 = v0 * (links[26] * v59 + links[29] * v60 + links[32] * v61);
    const float v66 = v5 * (sin_cos[9] * v62 - sin_cos[8] * v63) + v65;
    const float v67 = v35 * v40;
    const float v68 = links[1] * v32 + v39 * v67;
    const float v69 = links[0] * v32 + v43 * v67;
    const float v70 = v25 * v68 + v21 * v69;
    const float v71 = sin_cos[1] * v68 - sin_cos[0] * v69;
    const float v72 = links[2] * v32 + v47 * v67;
    const float v73 = v23 * v71 + v19 * v72;
    const float v74 = sin_cos[0] * v68 + sin_cos[1] * v69;
    const float v75 = sin_cos[3] * v71 - sin_cos[2] * v72;
    const float v76 = sin_cos[2] * v71 + sin_cos[3] * v72;
    const float v77 = links[13] * v74 + links[16] * v75 + links[19] * v76;
    const float v78 = links[12] * v74 + links[15] * v75 + links[18] * v76;
    const float v79 = v11 * v77 + v13 * v78;
    const float v80 = sin_cos[5] * v77 - sin_cos[4] * v78;
    const float v81 = links[14] * v74 + links[17] * v75 + links[20] * v76;
    const float v82 = v15 * v80 + v9 * v81;
    const float v83 = sin_cos[4] * v77 + sin_cos[5] * v78;
    const float v84 = sin_cos[7] * v80 - sin_cos[6] * v81;
    const float v85 = sin_cos[6] * v80 + sin_cos[7] * v81;
    const float v86 = links[25] * v83 + links[28] * v84 + links[31] * v85;
    const float v87 = links[24] * v83 + links[27] * v84 + links[30] * v85;
    const float v88 = v1 * v86 + v3 * v87;
    const float v89 = v0 * (links[26] * v83 + links[29] * v84 + links[32] * v85);
    const float v90 = v5 * (sin_cos[9] * v86 - sin_cos[8] * v87) + v89;
    out[0] = -v34;
    out[1] = -v36;
    out[2] = v45;
    out[3] = v49;
    out[4] = v55;
    out[5] = v58;
    out[6] = -v64;
    out[7] = -v66;
    out[8] = v70;
    out[9] = v73;
    out[10] = v79;
    out[11] = v82;
    out[12] = -v88;
    out[13] = -v90;
}

#ifdef __cplusplus
}
#endif

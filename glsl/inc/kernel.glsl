// Reconstruction kernels over r^2 = u^2 + v^2 <= COVERAGE_R2, by arithmetic.
// gaussian: exp(-r^2 / 2 sigma^2). psi_e: exp(-a q / (1 - q)), q = r^n (Pajarola, Sainz, Guidotti 2003, section 4; the
// paper's b scales r and the support alike). At q = 1 psi_e is its limit, 0; coverage ends before. pow(0, y) may be NaN. The host turns
// KERNEL_A to base 2, whose exponential is the hardware's own.

float kernel_weight(float r2)
{
    if (KERNEL == KERNEL_PSI_E) {
        float q = pow(max(r2, 1e-30), FORMULA(FORMULA_KERNEL_POWER, 0.5 * KERNEL_N));
        return exp2(-FORMULA(FORMULA_KERNEL, KERNEL_A) * q / max(1.0 - q, 1e-7));
    }
    return exp2(-FORMULA(FORMULA_KERNEL, KERNEL_A) * r2);
}

// By how much the weight's logarithm declines as r^2 grows, over KERNEL_A ln 2. Next to the rim of psi_e, where it has no end, the weight is none.
float kernel_decline(float r2)
{
    if (KERNEL == KERNEL_PSI_E) {
        float q = pow(max(r2, 1e-30), 0.5 * KERNEL_N);
        float left = max(1.0 - q, 1e-3);
        return 0.5 * KERNEL_N * q / (max(r2, 1e-30) * left * left);
    }
    return 1.0;
}

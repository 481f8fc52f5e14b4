// The module that calls Ceres Solver 2.1; nothing else in the house includes it.
#include "ceres/solve.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

namespace
{

class Function : public ceres::CostFunction
{
  public:
    Function(const sp_least_squares &problem, bool &broken) : problem_(problem), broken_(broken)
    {
        set_num_residuals(static_cast<int>(problem.residuals));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.unknowns));
    }

    bool Evaluate(double const *const *x, double *residuals, double **jacobians) const override
    {
        const size_t count = problem_.residuals, slopes = count * problem_.unknowns;
        double *jacobian = jacobians ? jacobians[0] : nullptr;
        broken_ = broken_ || !problem_.function(problem_.user, x[0], residuals, jacobian) ||
                  !finite(residuals, count) || (jacobian && !finite(jacobian, slopes));
        if (broken_) {
            // Ceres would print what it was given, and go on from where it was: nothing missing, and it ends.
            std::fill_n(residuals, count, 0.0);
            std::fill_n(jacobian, jacobian ? slopes : 0, 0.0);
        }
        return true;
    }

  private:
    static bool finite(const double *numbers, size_t count)
    {
        return std::all_of(numbers, numbers + count, [](double number) { return std::isfinite(number); });
    }

    const sp_least_squares &problem_;
    bool &broken_;
};

} // namespace

extern "C" __attribute__((visibility("default"))) bool sp_ceres_module_solve(const sp_least_squares *problem, double *x,
                                                                             double *cost, sp_error *error)
{
    try {
        bool broken = false;
        std::vector<double> found(x, x + problem->unknowns);
        ceres::Problem ceres_problem;
        ceres_problem.AddResidualBlock(new Function(*problem, broken), nullptr, found.data());
        ceres::Solver::Options options;
        options.minimizer_type = ceres::TRUST_REGION;
        options.linear_solver_type = ceres::DENSE_QR;
        options.max_num_iterations = problem->iterations;
        options.function_tolerance = problem->tolerance;
        options.gradient_tolerance = problem->tolerance;
        options.parameter_tolerance = problem->tolerance;
        options.num_threads = 1;
        options.logging_type = ceres::SILENT;
        options.minimizer_progress_to_stdout = false;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &ceres_problem, &summary);
        if (broken)
            return sp_fail(error, SP_ERROR_ARGUMENT, nullptr, 0, 0, "least squares: no residuals, or not of numbers");
        if (summary.termination_type == ceres::FAILURE)
            return sp_fail(error, SP_ERROR_ARGUMENT, nullptr, 0, 0, "least squares: %s", summary.message.c_str());
        std::copy(found.begin(), found.end(), x);
        if (cost)
            *cost = summary.final_cost;
        return true;
    } catch (const std::bad_alloc &) {
        sp_fail_memory(error);
        return false;
    } catch (const std::exception &exception) {
        return sp_fail(error, SP_ERROR_ARGUMENT, nullptr, 0, 0, "least squares: %s", exception.what());
    }
}

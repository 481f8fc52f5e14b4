#include "refine/ceres_adaptor.h"

#include <ceres/ceres.h>

#include <exception>
#include <limits>
#include <vector>

namespace
{

class Function : public ceres::CostFunction
{
  public:
    explicit Function(const sp_least_squares &problem) : problem_(problem)
    {
        set_num_residuals(static_cast<int>(problem.residuals));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.unknowns));
    }

    bool Evaluate(double const *const *x, double *residuals, double **jacobians) const override
    {
        return problem_.function(problem_.user, x[0], residuals, jacobians ? jacobians[0] : nullptr);
    }

  private:
    const sp_least_squares &problem_;
};

} // namespace

bool sp_ceres_solve(const sp_least_squares *problem, double *x, double *cost, sp_error *error)
{
    const size_t limit = static_cast<size_t>(std::numeric_limits<int>::max());
    if (!problem->unknowns || !problem->residuals || problem->unknowns > limit || problem->residuals > limit)
        return sp_fail(error, SP_ERROR_ARGUMENT, nullptr, 0, 0,
                       "a least squares problem of %zu unknowns, %zu residuals", problem->unknowns, problem->residuals);
    try {
        // Ceres logs an error to stderr where the first evaluation fails, whatever its logging type.
        std::vector<double> residuals(problem->residuals);
        if (!problem->function(problem->user, x, residuals.data(), nullptr))
            return sp_fail(error, SP_ERROR_ARGUMENT, nullptr, 0, 0, "least squares: no residuals at the start");
        ceres::Problem ceres_problem;
        ceres_problem.AddResidualBlock(new Function(*problem), nullptr, x);
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
        if (summary.termination_type == ceres::FAILURE)
            return sp_fail(error, SP_ERROR_ARGUMENT, nullptr, 0, 0, "least squares: %s", summary.message.c_str());
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

#include "boomer.hpp"

#include "mpi_session.hpp"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>

#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace hyperlattice::statics {

namespace {

void check(HYPRE_Int error, const char* what) {
  if (error == 0) return;
  char text[256] = "";
  HYPRE_DescribeError(error, text);
  HYPRE_ClearAllErrors();
  throw std::runtime_error(std::string("hypre cannot ") + what + ": " + text);
}

}  // namespace

struct Boomer::Handles {
  HYPRE_IJMatrix matrix = nullptr;
  HYPRE_IJVector right = nullptr, left = nullptr;
  HYPRE_ParCSRMatrix k = nullptr;
  HYPRE_ParVector b = nullptr, x = nullptr;
  HYPRE_Solver cycle = nullptr;

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (cycle != nullptr) HYPRE_BoomerAMGDestroy(cycle);
    if (matrix != nullptr) HYPRE_IJMatrixDestroy(matrix);
    for (HYPRE_IJVector vector : {right, left})
      if (vector != nullptr) HYPRE_IJVectorDestroy(vector);
  }

  void make_matrix(const SparseRows& rows, const std::vector<HYPRE_BigInt>& all) {
    const auto size = static_cast<HYPRE_Int>(all.size());
    std::vector<HYPRE_Int> entries = rows.entries;  // hypre asks for one that it may write to
    HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, size - 1, 0, size - 1, &matrix);
    HYPRE_IJMatrixSetObjectType(matrix, HYPRE_PARCSR);
    HYPRE_IJMatrixSetRowSizes(matrix, entries.data());
    HYPRE_IJMatrixInitialize(matrix);
    HYPRE_IJMatrixSetValues(matrix, size, entries.data(), all.data(), rows.column.data(), rows.value.data());
    HYPRE_IJMatrixAssemble(matrix);
    HYPRE_IJMatrixGetObject(matrix, reinterpret_cast<void**>(&k));
  }

  void make_vectors(HYPRE_BigInt size) {
    for (const auto& [vector, object] : {std::pair(&right, &b), std::pair(&left, &x)}) {
      HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, size - 1, vector);
      HYPRE_IJVectorSetObjectType(*vector, HYPRE_PARCSR);
      HYPRE_IJVectorInitialize(*vector);
      HYPRE_IJVectorAssemble(*vector);
      HYPRE_IJVectorGetObject(*vector, reinterpret_cast<void**>(object));
    }
  }

  /// Gauss-Seidel of l1 type goes down forwards and up backwards, so that the cycle is symmetric; between them, long-range interpolation of few
  /// entries.
  void make_cycle(int components, double strong_threshold) {
    constexpr HYPRE_Int down = 1, up = 2, coarsest = 3;
    constexpr HYPRE_Int forwards = 13, backwards = 14, elimination = 9, hmis = 10, extended = 6, entries_of_interpolation = 4;
    HYPRE_BoomerAMGCreate(&cycle);
    HYPRE_BoomerAMGSetMaxIter(cycle, 1);
    HYPRE_BoomerAMGSetTol(cycle, 0);
    HYPRE_BoomerAMGSetPrintLevel(cycle, 0);
    HYPRE_BoomerAMGSetNumFunctions(cycle, components);
    HYPRE_BoomerAMGSetStrongThreshold(cycle, strong_threshold);
    HYPRE_BoomerAMGSetMaxRowSum(cycle, 1);
    HYPRE_BoomerAMGSetCoarsenType(cycle, hmis);
    HYPRE_BoomerAMGSetInterpType(cycle, extended);
    HYPRE_BoomerAMGSetPMaxElmts(cycle, entries_of_interpolation);
    HYPRE_BoomerAMGSetRelaxOrder(cycle, 0);
    HYPRE_BoomerAMGSetNumSweeps(cycle, 1);
    HYPRE_BoomerAMGSetCycleRelaxType(cycle, forwards, down);
    HYPRE_BoomerAMGSetCycleRelaxType(cycle, backwards, up);
    HYPRE_BoomerAMGSetCycleRelaxType(cycle, elimination, coarsest);
  }
};

Boomer::Boomer(const SparseRows& rows, int components, double strong_threshold) : all_(rows.entries.size()) {
  if (rows.column.size() > static_cast<std::size_t>(std::numeric_limits<HYPRE_Int>::max()))
    throw std::runtime_error("the tangent has " + std::to_string(rows.column.size()) + " entries, more than hypre can count");
  start_mpi();
  handles_ = std::make_unique<Handles>();
  std::iota(all_.begin(), all_.end(), HYPRE_BigInt{0});
  handles_->make_matrix(rows, all_);
  handles_->make_vectors(static_cast<HYPRE_BigInt>(all_.size()));
  check(HYPRE_GetError(), "take the tangent");
  handles_->make_cycle(components, strong_threshold);
  check(HYPRE_GetError(), "take its options");
  check(HYPRE_BoomerAMGSetup(handles_->cycle, handles_->k, handles_->b, handles_->x), "make its levels");
}

Boomer::~Boomer() = default;

void Boomer::apply(const Field& r, Field& z) {
  const auto size = static_cast<HYPRE_Int>(all_.size());
  HYPRE_IJVectorSetValues(handles_->right, size, all_.data(), r.data());
  HYPRE_ParVectorSetConstantValues(handles_->x, 0);
  HYPRE_BoomerAMGSolve(handles_->cycle, handles_->k, handles_->b, handles_->x);
  HYPRE_IJVectorGetValues(handles_->left, size, all_.data(), z.data());
  if (HYPRE_CheckError(HYPRE_GetError(), HYPRE_ERROR_CONV) != 0) HYPRE_ClearError(HYPRE_ERROR_CONV);  // one cycle is not meant to converge
  check(HYPRE_GetError(), "apply its cycle");
}

}  // namespace hyperlattice::statics

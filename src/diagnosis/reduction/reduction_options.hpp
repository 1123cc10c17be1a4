#pragma once

namespace twindeck::diagnosis {

struct ReductionOptions {
  int modes = 30;                 ///< number of modes of the unchanged structure in the basis
  int parameter_vectors = 10;     ///< most corrections for changed parameters and element scatter; the strongest are kept
  double least_correction = 0.0;  ///< corrections below this part of omega² of every mode are left out
  double element_change = 0.0;    ///< relative change of a group of elements by element scatter; 0: no corrections
  int corrected_modes = 8;        ///< number of lowest modes whose static responses to a change at a location are used
  int vectors_per_place = 3;      ///< most vectors of a location: the strongest directions of these responses
  int vectors_per_move = 8;       ///< most vectors of a support that may stand elsewhere on its line
  int full_below = 60;            ///< a structure with at most this number of dofs is not reduced
};

}  // namespace twindeck::diagnosis

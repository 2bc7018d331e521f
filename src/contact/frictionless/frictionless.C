// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "frictionless.H"
#include "addToRunTimeSelectionTable.H"

namespace Foam
{
defineTypeNameAndDebug(frictionless, 0);
addToRunTimeSelectionTable(frictionLaw, frictionless, dictionary);
}

// ************************************************************************* //

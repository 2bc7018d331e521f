// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "noSlipFriction.H"
#include "addToRunTimeSelectionTable.H"

namespace Foam
{
defineTypeNameAndDebug(noSlipFriction, 0);
addToRunTimeSelectionTable(frictionLaw, noSlipFriction, dictionary);
}

// ************************************************************************* //

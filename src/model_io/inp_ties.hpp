#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: *TIE joins two meshes that need not match. Equations are collected; those of one node that together
/// are a rigid link become one, others constraints.
namespace twindeck::model_io {

/// Every slave node follows the point of the master surface that is nearest to it, by the shape functions of the facet there:
/// u_s = sum N_i u_i, and over a gap as the facet turns. Rotations follow where both sides have them (shells). Nodes further
/// from the surface than POSITION TOLERANCE stay free; without that parameter it is 5 % of the size of a master facet and half
/// the thicknesses of shells.
/// @throws InputError  for unknown surfaces, where no node at all is near enough, for a slave that follows something else
/// already
void attach_inp_tie(InpParts& parts, const InpCard& card);

void read_inp_equation(InpParts& parts, const InpCard& card);
void attach_inp_equations(InpParts& parts);
void attach_inp_rigid_body(InpParts& parts, const InpCard& card);
void attach_inp_mpc(InpParts& parts, const InpCard& card);
/// *COUPLING with the card below it. *KINEMATIC: the nodes of the surface follow the reference node as a rigid body, in the
/// degrees of freedom that are named (all without a data line). *DISTRIBUTING: the reference node moves as the mean of the
/// surface's displacements (DeckModel::tie_to_mean), each node with the same weight; its rotations may be left free.
/// @throws InputError  for a surface that is not there, other weights, local axes, a node that follows something else already
void attach_inp_coupling(InpParts& parts, const InpCard& card);
/// *KINEMATIC COUPLING: the older form, whose data lines name nodes, first and last degree of freedom.
void attach_inp_kinematic_coupling(InpParts& parts, const InpCard& card);
/// Drops constraints of displacements that are held as all that they follow is. @throws InputError for those that contradict a
/// support
void settle_inp_constraints(InpParts& parts);

}  // namespace twindeck::model_io

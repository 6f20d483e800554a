#include "gfb_petsc.h"
!> How the film's torque follows a tilt, and how firmly the free edge of a top foil rests, at an answer.
!>
!> Along a tilt \( t \) the bearing's equations are \( f(x, t) = 0 \). So \( f_x x' = -f_t \), and
!> the torque changes by \( w \cdot p' \), where \( p' \) are the pressures in \( x' \): the weights
!> \( w \) of [Gu2020] eq. 16 do not depend on the tilt. What the bearing keeps is kept: the shaft's
!> position where it is fixed, the load where it floats. Contacts stay on the tangents of their laws.
module gfb_static_stiffness
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use petscksp
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks, any_rank
  use gfb_film_load, only: film_forces
  use gfb_pad, only: pad_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_pad_contacts, only: linearise_exactly
  use gfb_newton, only: newton_type, solve_with_factors
  use gfb_direct_solver, only: use_factors, make_factors
  use gfb_bearing_directions, only: edge_direction
  implicit none (type)
  private
  public :: angular_stiffness, find_edge_stiffness

  integer, parameter :: tilts = 3 !! the shaft's coordinates before its tilts

  real(wp), parameter :: probe = 1.0e-3_wp !! force on the edge, over the size of a force; the answer is linear in it [1]

contains

  !> Derivatives of the film's torque on the shaft by the tilt, at the bearing's present state, that
  !> must be an answer over the whole width; not a number where the matrix cannot be factorized. Costs
  !> one factorization.
  subroutine angular_stiffness(bearing, newton, stiffness)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    type(newton_type), intent(inout) :: newton !! its factorizations are counted
    real(wp), intent(out) :: stiffness(2, 2)   !! torque about x, y by tilt about x, y [N m/rad]

    KSP :: linear
    Vec :: change, response
    KSPConvergedReason :: reason
    PetscErrorCode :: ierr
    integer :: axis
    logical :: moved, made

    stiffness = ieee_value(1.0_wp, ieee_quiet_nan)
    call bearing%settle(bearing%state, moved)
    call linearise_exactly(bearing, bearing%shaft_fixed) ! regular, as the foils are fixed at an edge
    newton%factorizations = newton%factorizations + 1
    call create_solver(bearing, linear)
    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    PetscCallA(VecDuplicate(bearing%state, response, ierr))
    call make_factors(linear, bearing%jacobian, made, newton%enlargements)
    do axis = 1, merge(2, 0, made)
      call bearing%shaft_column(tilts + axis, change)
      PetscCallA(KSPSolve(linear, change, response, ierr))
      PetscCallA(KSPGetConvergedReason(linear, reason, ierr))
      if (GFB_REASON(reason) > 0) stiffness(:, axis) = -torque_of(bearing, axis, response)
    end do
    PetscCallA(VecDestroy(response, ierr))
    PetscCallA(VecDestroy(change, ierr))
    PetscCallA(KSPDestroy(linear, ierr))
  end subroutine angular_stiffness

  !> A direct solver of the bearing's matrix, with the orderings of Newton's method.
  subroutine create_solver(bearing, linear)
    type(bearing_system_type), intent(in) :: bearing
    KSP, intent(out) :: linear
    PetscErrorCode :: ierr

    PetscCallA(KSPCreate(PETSC_COMM_WORLD, linear, ierr))
    PetscCallA(KSPSetOptionsPrefix(linear, 'bearing_', ierr))
    PetscCallA(KSPSetOperators(linear, bearing%jacobian, bearing%jacobian, ierr))
    call use_factors(linear, 'bearing_', .false., bearing%dense_rows, low_fill=bearing%low_fill, matrix=bearing%jacobian, plane=bearing%plane)
    PetscCallA(KSPSetFromOptions(linear, ierr))
  end subroutine create_solver

  !> Torque of the pressures in a change of the state against a tilt [N m].
  function torque_of(bearing, axis, response) result(torque)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: axis    !! of the tilt
    Vec, intent(in) :: response    !! the change, scaled
    real(wp) :: torque(2)
    real(wp) :: change(bearing%local_size()), here(bearing%local_size()), force(film_forces)

    call bearing%get_unknowns(here)
    call bearing%get_unknowns(change, response)
    force = sum_over_ranks(bearing%film_force(bearing%ambient_pressure + bearing%film_pressure(change) &
                                              + solid_change(bearing, axis, here, change)))
    torque = force(4:5)
  end function torque_of

  !> How much less the asperities press: their pressure follows the gap, that is foil, shaft and tilt.
  function solid_change(bearing, axis, here, change) result(pressure)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: axis          !! of the tilt
    real(wp), intent(in) :: here(:)      !! local unknowns, in SI
    real(wp), intent(in) :: change(:)    !! of them, against the tilt [per radian]
    real(wp) :: pressure(bearing%film_nodes()) !! [Pa/rad]
    real(wp) :: gap(size(pressure))
    integer :: i

    pressure = 0.0_wp
    if (.not. bearing%asperities%present) return
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        gap(pad%first_node + 1:pad%last_node) = pad_change(pad, axis, change(pad%first + 1:pad%last), &
                                                           change(bearing%first_shaft + 1:))
      end associate
    end do
    pressure = bearing%solid_rate(bearing%gap(here))*gap
  end function solid_change

  !> How the gap over a pad changes: its foil, the shaft and the tilt move.
  pure function pad_change(pad, axis, change, shaft_change) result(gap)
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: axis             !! of the tilt
    real(wp), intent(in) :: change(:)       !! of the pad's unknowns, against the tilt [per radian]
    real(wp), intent(in) :: shaft_change(:) !! of the shaft's, where it has any [m/rad]
    real(wp) :: gap(size(pad%film%angle))   !! [m/rad]
    integer :: node

    gap = -pad%film%motion(tilts + axis, :)
    if (size(shaft_change) > 0) gap = gap + shaft_change(1)*pad%film%motion(1, :) + shaft_change(2)*pad%film%motion(2, :)
    associate (foil => pad%foil)
      do node = 1, size(gap)
        if (foil%source(node) > 0) gap(node) = gap(node) + foil%rate(node)*change(foil%source(node))
      end do
    end associate
  end function pad_change

  !> Force that lifts a pad's free edge over its mean displacement, with films, foils and shaft following:
  !> \( 1/(e^T J^{-1} e) \). Below zero the edge moves on by itself.
  subroutine find_edge_stiffness(bearing, newton, known, stiffness)
    type(bearing_system_type), intent(inout) :: bearing !! at an answer, and at the same one after
    type(newton_type), intent(in) :: newton !! with the factors of `find_determinant_sign`
    logical, allocatable, intent(out) :: known(:) !! each pad has a free edge, and it moves
    real(wp), allocatable, intent(out) :: stiffness(:) !! of each edge [N/m]
    Vec :: force, own, change, edge
    real(wp) :: lift
    PetscErrorCode :: ierr
    integer :: i

    allocate (stiffness(size(bearing%pad)), source=0.0_wp)
    known = [(any_rank(size(bearing%pad(i)%edge%unknown) > 0), i=1, size(bearing%pad))]
    if (.not. any(known)) return
    PetscCallA(VecDuplicate(bearing%state, force, ierr))
    PetscCallA(VecDuplicate(bearing%state, own, ierr))
    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    PetscCallA(VecDuplicate(bearing%state, edge, ierr))
    call lifting_force(bearing, change, force)
    do i = 1, size(bearing%pad)
      call keep_pad(bearing, i, force, own)
      call solve_with_factors(newton, own, change)
      call edge_direction(bearing, edge, i)
      PetscCallA(VecDot(edge, change, lift, ierr))
      lift = lift*bearing%clearance
      known(i) = abs(lift) > 0.0_wp
      if (known(i)) stiffness(i) = probe*bearing%force_scale()/lift
    end do
    PetscCallA(VecDestroy(force, ierr))
    PetscCallA(VecDestroy(own, ierr))
    PetscCallA(VecDestroy(change, ierr))
    PetscCallA(VecDestroy(edge, ierr))
  end subroutine find_edge_stiffness

  !> How a force on the edges of all pads changes the equations.
  subroutine lifting_force(bearing, work, force)
    type(bearing_system_type), intent(inout) :: bearing !! is left as it is
    Vec, intent(in) :: work  !! is overwritten
    Vec, intent(in) :: force !! taken away from the residual, scaled
    real(wp) :: pull_before(size(bearing%point%edge_pull))
    logical :: valid
    PetscErrorCode :: ierr

    call bearing%evaluate(bearing%state, force, valid)
    pull_before = bearing%point%edge_pull
    bearing%point%edge_pull = pull_before + probe*bearing%force_scale()
    call bearing%evaluate(bearing%state, work, valid)
    bearing%point%edge_pull = pull_before
    PetscCallA(VecAXPY(force, -1.0_wp, work, ierr))
  end subroutine lifting_force

  !> What of a vector belongs to the equations of one pad.
  subroutine keep_pad(bearing, pad, vector, own)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: pad !! its number
    Vec, intent(in) :: vector, own
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(vector, own, ierr))
    PetscCallA(GFB_VecGetArray(own, values, ierr))
    associate (before => bearing%blocks%first_owned(2*pad - 1), last => bearing%blocks%first_owned(2*pad + 1))
      values(:before) = 0.0_wp
      values(last + 1:) = 0.0_wp
    end associate
    PetscCallA(GFB_VecRestoreArray(own, values, ierr))
  end subroutine keep_pad
end module gfb_static_stiffness

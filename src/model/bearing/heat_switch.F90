#include "gfb_petsc.h"
!> Heat comes to a bearing, or stays as it is from an answer on.
module gfb_heat_switch
  use petscvec
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_text, only: text
  use gfb_natural_order, only: visit_vector
  use gfb_petsc_session, only: any_rank
  use gfb_gas_film, only: frozen_heat_type, freeze_film, frozen_fields, frozen_growth
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_heat, only: film_heat_type, growth_of, temperatures_at
  use gfb_bearing_system, only: bearing_system_type, bearing_order, set_up_equations, free_equations
  implicit none (type)
  private
  public :: add_heat, freeze_heat, hold_heat, let_go, follow_frozen, visit_frozen

  !> A bearing as a motion of its shaft meets it, see `hold_heat`. What it has of its own is freed when the variable goes, however
  !> the procedure ends.
  type, public :: held_bearing_type
    type(bearing_system_type), pointer :: bearing => null()
    logical, private :: has_own = .false. !! it is not the bearing that was given
  contains
    final :: let_go
  end type held_bearing_type

contains

  !> Gives a bearing without heat its heat: all temperatures begin as that of the gas that is drawn in, all else stays. Whoever
  !> solves its equations is created anew.
  subroutine add_heat(bearing, heat)
    type(bearing_system_type), intent(inout) :: bearing !! at a state
    type(film_heat_type), intent(in) :: heat !! of it
    real(wp) :: before(bearing%local_size())
    real(wp), allocatable :: unknown(:)
    integer :: pads !! their unknowns
    logical :: iterates

    pads = bearing%first_scalar
    iterates = bearing%has_motions
    call bearing%get_unknowns(before)
    call free_equations(bearing)
    bearing%heat = heat
    call set_up_equations(bearing)
    if (iterates) call bearing%find_motions() ! temperatures are unknowns of their own
    allocate (unknown(bearing%local_size()), source=heat%ambient)
    unknown(:pads) = before(:pads)
    unknown(bearing%heat%last() + 1:) = before(pads + 1:)
    call bearing%set_unknowns(unknown)
  end subroutine add_heat

  !> The bearing at its answer, all temperatures as they are there from now on: heat is slow against what a shaft does. It shares
  !> the foils; `free_equations` frees what it has of its own.
  subroutine freeze_heat(bearing, frozen)
    type(bearing_system_type), intent(in) :: bearing !! with heat
    type(bearing_system_type), intent(out) :: frozen
    real(wp) :: unknown(bearing%local_size())
    type(frozen_heat_type) :: film
    type(operating_point_type) :: at_rest
    integer :: i

    call bearing%get_unknowns(unknown)
    frozen = bearing
    film%gas = bearing%heat%gas
    film%centrifugal = bearing%heat%centrifugal
    at_rest = bearing%point
    at_rest%speed = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        allocate (film%field(size(pad%mesh%mesh_node), frozen_fields))
        film%field(:, :frozen_growth - 1) = temperatures_at(bearing%heat, i, pad%mesh%mesh_node, pad%whole%rows(), unknown)
        film%field(:, frozen_growth) = growth_of(bearing%heat, pad%mesh%mesh_node, pad%whole%rows(), at_rest, unknown)
        call freeze_film(frozen%pad(i)%film, film)
        call frozen%pad(i)%foil%soften(bearing%modulus(i, unknown))
        deallocate (film%field)
      end associate
    end do
    frozen%heat = film_heat_type()
    call set_up_equations(frozen)
    if (bearing%has_motions) call frozen%find_motions()
    call frozen%set_unknowns([unknown(:bearing%heat%first(1)), unknown(bearing%heat%last() + 1:)])
  end subroutine freeze_heat

  !> What a motion of the shaft meets: the bearing itself, or where heat is solved for one whose temperatures stay as they are.
  subroutine hold_heat(bearing, held)
    type(bearing_system_type), target, intent(inout) :: bearing !! at its answer
    type(held_bearing_type), intent(out) :: held !! of it

    held%bearing => bearing
    held%has_own = bearing%has_slow_unknowns()
    if (.not. held%has_own) return
    allocate (held%bearing)
    call freeze_heat(bearing, held%bearing)
  end subroutine hold_heat

  !> Frees the equations of a bearing of its own, which shares all else.
  subroutine let_go(self)
    type(held_bearing_type), intent(inout) :: self !! goes

    if (self%has_own) then
      call free_equations(self%bearing)
      deallocate (self%bearing)
    end if
    self%has_own = .false.
    nullify (self%bearing)
  end subroutine let_go

  !> Gives films that have none the temperatures of others, which are meshed alike, and foils their moduli; of two bearings both
  !> have them.
  subroutine follow_frozen(bearing, other)
    type(bearing_system_type), intent(in) :: bearing !! whose temperatures may stay as they are
    type(bearing_system_type), intent(inout) :: other !! without heat
    integer :: i

    do i = 1, size(other%pad)
      associate (from => bearing%pad(modulo(i - 1, size(bearing%pad)) + 1))
        if (.not. allocated(from%film%frozen)) cycle
        call freeze_film(other%pad(i)%film, from%film%frozen)
        call other%pad(i)%foil%soften(from%foil%modulus)
      end associate
    end do
  end subroutine follow_frozen

  !> Saves or restores temperatures that stay as they are, the growth and the moduli by them. All ranks ask.
  subroutine visit_frozen(archive, bearing)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(bearing_system_type), intent(inout) :: bearing !! whose films may have them
    character(len=*), parameter :: name(frozen_fields) = [character(len=20) :: 'gas_temperature', 'top_foil_temperature', 'shaft_temperature', &
                                                                   'growth']
    real(wp) :: value(bearing%local_size()), modulus(2)
    type(frozen_heat_type) :: film
    Vec :: vector
    PetscErrorCode :: ierr
    integer :: i, k
    logical :: cold

    if (.not. allocated(bearing%pad(1)%film%frozen)) return
    cold = .false.
    PetscCallA(VecDuplicate(bearing%state, vector, ierr))
    do k = 1, size(name)
      value = 0.0_wp
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i), nodes => size(bearing%pad(i)%film%angle))
          value(pad%first + 1:pad%first + nodes) = pad%film%frozen%field(:, k)
        end associate
      end do
      call bearing%exchange%put(value, vector)
      call visit_vector(archive, trim(name(k)), bearing_order(bearing), vector)
      if (archive%saves) cycle
      call bearing%exchange%get(vector, value)
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i), nodes => size(bearing%pad(i)%film%angle))
          bearing%pad(i)%film%frozen%field(:, k) = value(pad%first + 1:pad%first + nodes)
        end associate
      end do
    end do
    PetscCallA(VecDestroy(vector, ierr))
    if (.not. archive%saves) then
      do i = 1, size(bearing%pad)
        cold = cold .or. any(bearing%pad(i)%film%frozen%field(:, :frozen_growth - 1) <= 0.0_wp)
      end do
      call archive%require(.not. any_rank(cold), 'a temperature')
    end if
    do i = 1, size(bearing%pad)
      modulus = bearing%pad(i)%foil%modulus
      call archive%visit('modulus_'//text(i), modulus)
      if (.not. archive%saves) call archive%require(all(modulus > 0.0_wp), 'a modulus')
      if (archive%failed) return
      if (.not. archive%saves) call bearing%pad(i)%foil%soften(modulus)
    end do
    if (archive%saves) return
    do i = 1, size(bearing%pad)
      film = bearing%pad(i)%film%frozen
      call freeze_film(bearing%pad(i)%film, film)
    end do
  end subroutine visit_frozen
end module gfb_heat_switch

!> The contacts of this rank: nodes of a foil on the sleeve, under a plate, or under another foil.
!>
!> Geometry is that of the unloaded foils: displacements are small. Each contact remembers where
!> on its law it is linearised. Within a Newton step its force is the law's tangent there, a pure
!> function of the unknowns; `settle` moves the linearisation points after the step. So the matrix
!> describes the whole of a step, and a contact that jumps from one state to another cannot spoil the
!> line search.
module gfb_contact_set
  use gfb_kinds, only: wp
  use gfb_contact_law, only: contact_law_type, contact_force, friction_force, normal_force, carried_slip, next_place, &
                             contact_state, state_open, keep_friction
  use gfb_contact_point, only: contact_point_type, spatial, moved_apart, add_at_contact, unknowns_of, &
                               block_of
  implicit none (type, external)
  private

  real(wp), parameter :: touching = 1.0e-8_wp !! penetration that counts, over the typical one

  !> All contacts of this rank, and the unknowns they touch.
  type, public :: contact_set_type
    type(contact_law_type), allocatable :: law(:)
    type(contact_point_type), allocatable :: point(:)
    integer :: rows = 1                        !! nodes of a contact line, in the slaves' mesh
    logical :: at_faces = .false.              !! faces touch, not mid-surfaces
    integer, allocatable :: global(:)          !! numbers, from 0, of the unknowns they touch
    real(wp) :: secant_penetration = 0.0_wp    !! glued contacts are as stiff as at this one [m]
    real(wp) :: artificial_tangential = 0.0_wp !! of a slave in the matrix alone, per length
    real(wp) :: artificial_normal = 0.0_wp     !! [N/m2], so that a floating foil leaves it regular
    logical :: artificial = .true.             !! the matrix has it; without, it is exact
    real(wp) :: softening = 1.0_wp             !! factor of the stick length, of a homotopy
    real(wp) :: hardness = 1.0_wp              !! factor of the normal stiffness, of a homotopy
    real(wp) :: adhesion = 0.0_wp              !! stiffness against opening over that, of a homotopy
    logical :: glued = .false.                 !! closed whatever happens, free to slide: a first guess
    logical :: settled = .true.                !! every contact is linearised where it is
    logical :: sticks_in_motion = .false.      !! what `keeps_friction` becomes where the foils begin to move
    logical :: keeps_friction = .false.        !! what sticks keeps its friction whatever presses, to Coulomb's limit
    logical, allocatable :: closed(:)          !! along a step; before it as the contacts are linearised
  contains
    procedure, non_overridable :: approach, next_change, add_penetration_rate, settle, settle_like, linearise_again
    procedure, non_overridable :: drop_anchor, settle_at, add_forces, point_block, point_unknowns, commit
    procedure, non_overridable :: friction_work, penalty_energy, state_of, is_open, pressing_force, law_of
  end type contact_set_type

contains

  !> Law of a contact, softened where a homotopy asks for it.
  pure function law_of(self, point) result(law)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    type(contact_point_type), intent(in) :: point !! one of the set's contacts
    type(contact_law_type) :: law

    law = self%law(point%law)
    law%stick_length = law%stick_length*self%softening
    law%normal_stiffness = law%normal_stiffness*self%hardness*point%hardness
    law%adhesion = self%adhesion
    law%stick_pressing = point%stick_pressing
  end function law_of

  !> Slip and penetration of a contact, (s_1, s_2, delta) [m].
  pure function approach(self, i, displacement) result(value)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer, intent(in) :: i                    !! contact
    real(wp), intent(in) :: displacement(:)     !! of the set's unknowns [m]
    real(wp) :: value(spatial)

    associate (point => self%point(i))
      value = matmul(moved_apart(point, displacement), point%frame)
      value(:2) = value(:2) - point%shift
      if (self%law(point%law)%one_way) value(2) = 0.0_wp
      value(3) = -value(3) - point%gap
    end associate
  end function approach

  !> The fraction of the path from one displacement to another, or on beyond it, after which a
  !> contact opens or closes; huge where it never does.
  pure real(wp) function next_change(self, i, here, ahead) result(fraction)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer, intent(in) :: i                      !! contact
    real(wp), intent(in) :: here(:), ahead(:)     !! of the set's unknowns [m]
    real(wp) :: first(spatial), last(spatial)

    fraction = huge(fraction)
    if (self%point(i)%pressed) return
    first = self%approach(i, here)
    last = self%approach(i, ahead)
    if (first(3)*(last(3) - first(3)) >= 0.0_wp) return ! the penetration goes away from zero
    fraction = first(3)/(first(3) - last(3))
  end function next_change

  !> Adds the derivatives of a contact's penetration after the set's unknowns, times a factor.
  pure subroutine add_penetration_rate(self, i, factor, rate)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer, intent(in) :: i !! contact
    real(wp), intent(in) :: factor !! of the derivatives [1]
    real(wp), intent(inout) :: rate(:) !! by each of the set's unknowns [1]
    call add_at_contact(self%point(i), -factor*self%point(i)%frame(:, 3), rate)
  end subroutine add_penetration_rate

  !> Moves every contact's linearisation point to where the foils are now.
  pure subroutine settle(self, displacement)
    class(contact_set_type), intent(inout) :: self !! this rank's contacts
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m]
    type(contact_law_type) :: law
    real(wp) :: now(spatial)
    integer :: i

    self%settled = .true.
    do i = 1, size(self%point)
      associate (point => self%point(i))
        law = self%law_of(point)
        if (self%glued) then
          call glue(self, point)
          cycle
        end if
        now = self%approach(i, displacement)
        point%place = next_place(law, point%anchor, now)
        call linearise(law, point)
        if (any(abs(point%place - now) > 0.0_wp) .and. any(abs(point%derivative) > 0.0_wp)) self%settled = .false.
      end associate
    end do
  end subroutine settle

  !> Linearises every contact where that of a set like this one is, which also sets what it remembers. So the
  !> contacts stay open, stick or slide as those do, whatever gaps and laws are here.
  pure subroutine settle_like(self, other)
    class(contact_set_type), intent(inout) :: self !! this rank's contacts
    type(contact_set_type), intent(in) :: other    !! of another foil on the same mesh
    integer :: i

    do i = 1, size(self%point)
      associate (point => self%point(i), like => other%point(i))
        point%shift = like%shift
        point%old_slip = like%old_slip
        point%old_force = like%old_force
        point%stick_pressing = like%stick_pressing
        point%place = like%place
        point%anchor = like%anchor
      end associate
    end do
    call self%linearise_again()
    self%settled = .true.
  end subroutine settle_like

  !> Linearises every contact where it is, with what its law is now.
  pure subroutine linearise_again(self)
    class(contact_set_type), intent(inout) :: self !! this rank's contacts
    integer :: i

    do i = 1, size(self%point)
      call linearise(self%law_of(self%point(i)), self%point(i))
    end do
  end subroutine linearise_again

  !> Force of a contact and its derivative where it is linearised.
  pure subroutine linearise(law, point)
    type(contact_law_type), intent(in) :: law
    type(contact_point_type), intent(inout) :: point
    real(wp) :: slope(2)

    if (point%pressed) then
      point%force = 0.0_wp
      point%derivative = 0.0_wp
      call friction_force(law, point%place(:2), point%pressing, point%force(:2), point%derivative(:2, :2), slope)
    else
      call contact_force(law, point%length, point%place, point%force, point%derivative)
    end if
  end subroutine linearise

  !> A new Newton step begins where the contacts are.
  pure subroutine drop_anchor(self)
    class(contact_set_type), intent(inout) :: self !! this rank's contacts
    integer :: i

    do i = 1, size(self%point)
      self%point(i)%anchor = self%point(i)%place
    end do
  end subroutine drop_anchor

  !> Linearises every contact at a state that was an answer, whatever was tried since.
  pure subroutine settle_at(self, displacement)
    class(contact_set_type), intent(inout) :: self !! this rank's contacts
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m]
    integer :: i

    do i = 1, size(self%point)
      self%point(i)%anchor = self%approach(i, displacement)
    end do
    call self%settle(displacement)
  end subroutine settle_at

  !> A two-way spring without friction.
  pure subroutine glue(set, point)
    class(contact_set_type), intent(in) :: set
    type(contact_point_type), intent(inout) :: point
    real(wp) :: force(spatial), derivative(spatial, spatial)

    point%place = 0.0_wp
    point%force = 0.0_wp
    point%derivative = 0.0_wp
    if (point%pressed) return
    call contact_force(set%law(point%law), point%length, [0.0_wp, 0.0_wp, set%secant_penetration], &
                       force, derivative)
    point%derivative(3, 3) = force(3)/set%secant_penetration
  end subroutine glue

  !> Adds the contacts' forces on slaves and masters.
  pure subroutine add_forces(self, displacement, force)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m]
    real(wp), intent(inout) :: force(:)     !! on them [N]
    real(wp) :: on_slave(spatial)
    integer :: i

    do i = 1, size(self%point)
      associate (point => self%point(i))
        on_slave = point%force + matmul(point%derivative, self%approach(i, displacement) - point%place)
        call add_at_contact(point, matmul(point%frame, on_slave), force)
      end associate
    end do
  end subroutine add_forces

  !> The set's unknowns of a contact: slave, then master nodes, then turns; 0 where they are fixed.
  pure function point_unknowns(self, i) result(unknown)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer, intent(in) :: i !! contact
    integer, allocatable :: unknown(:)
    unknown = unknowns_of(self%point(i))
  end function point_unknowns

  !> Stiffness of a contact, -(force by displacement), in the order of `point_unknowns` [N/m].
  pure function point_block(self, i) result(block)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer, intent(in) :: i !! contact
    real(wp), allocatable :: block(:, :)
    real(wp) :: own(spatial, spatial)

    associate (point => self%point(i))
      own = -point%derivative
      own(:, 3) = -own(:, 3) ! penetration grows against the normal
      if (.not. point%pressed .and. .not. self%glued .and. .not. own(3, 3) > 0.0_wp) then
        own(3, 3) = merge(self%artificial_normal, 0.0_wp, self%artificial)*point%length
      end if
      own(1, 1) = own(1, 1) + self%artificial_tangential*point%length
      own(2, 2) = own(2, 2) + self%artificial_tangential*point%length
      own = matmul(point%frame, matmul(own, transpose(point%frame)))
      block = block_of(point, own)
    end associate
  end function point_block

  !> Ends a load step: friction carries its slip along as its law says.
  pure subroutine commit(self, displacement)
    class(contact_set_type), intent(inout) :: self !! this rank's contacts
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m]
    real(wp) :: now(spatial), pressing, total(2), kept(2), before
    integer :: i

    do i = 1, size(self%point)
      now = self%approach(i, displacement)
      associate (point => self%point(i))
        pressing = merge(point%pressing, point%force(3), point%pressed)
        total = now(:2) + point%shift
        if (self%keeps_friction) then
          before = point%stick_pressing
          call keep_friction(self%law_of(point), now(:2), pressing, kept, point%stick_pressing)
          if (before*point%stick_pressing > 0.0_wp) point%place(:2) = point%place(:2)*(before/point%stick_pressing)
        else
          kept = carried_slip(self%law(point%law), now(:2), total - point%old_slip, pressing)
        end if
        point%shift = total - kept
        ! The linearisation point stays, for the step's slip; the next step begins at the anchor.
        point%anchor = [total - point%shift, point%place(3)]
        point%old_slip = total
        point%old_force = point%force(:2)
      end associate
    end do
  end subroutine commit

  !> Work done against friction since the last commit, by the trapezoid rule [J].
  pure real(wp) function friction_work(self, displacement) result(work)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m]
    real(wp) :: now(spatial)
    integer :: i

    work = 0.0_wp
    do i = 1, size(self%point)
      now = self%approach(i, displacement)
      associate (point => self%point(i))
        work = work - 0.5_wp*dot_product(point%force(:2) + point%old_force, &
                                         now(:2) + point%shift - point%old_slip)
      end associate
    end do
  end function friction_work

  !> Energy stored in the penetrations [J].
  pure real(wp) function penalty_energy(self) result(energy)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer :: i

    energy = 0.0_wp
    do i = 1, size(self%point)
      associate (point => self%point(i))
        if (point%pressed) cycle
        energy = energy + point%force(3)*max(point%place(3), 0.0_wp)/(self%law(point%law)%exponent + 1.0_wp)
      end associate
    end do
  end function penalty_energy

  !> Whether a contact is open, sticks or slips.
  elemental integer function state_of(self, i) result(state)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer, intent(in) :: i !! contact
    type(contact_law_type) :: law
    real(wp) :: pressing

    associate (point => self%point(i))
      pressing = merge(point%pressing, point%force(3), point%pressed)
      ! What an unloaded foil keeps is round-off.
      if (.not. point%pressed .and. point%place(3) <= touching*self%secant_penetration) pressing = 0.0_wp
      law = self%law(point%law)
      law%stick_pressing = point%stick_pressing
      state = contact_state(law, norm2(point%place(:2)), pressing)
    end associate
  end function state_of

  !> Whether a contact touches nothing.
  elemental logical function is_open(self, i)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer, intent(in) :: i !! contact
    is_open = self%state_of(i) == state_open
  end function is_open

  !> The normal force of a contact's law where it is, wherever it is linearised [N].
  pure real(wp) function pressing_force(self, i, displacement) result(force)
    class(contact_set_type), intent(in) :: self !! this rank's contacts
    integer, intent(in) :: i                    !! contact
    real(wp), intent(in) :: displacement(:)     !! of the set's unknowns [m]
    real(wp) :: place(spatial), slope

    place = self%approach(i, displacement)
    call normal_force(self%law_of(self%point(i)), self%point(i)%length, place(3), force, slope)
  end function pressing_force
end module gfb_contact_set

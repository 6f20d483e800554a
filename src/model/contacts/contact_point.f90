!> A contact's point: a slave node and what it touches, how the foils' unknowns move the two apart.
module gfb_contact_point
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: moved_apart, add_at_contact, unknowns_of, block_of

  integer, parameter, public :: spatial = 3

  !> A slave node and what it touches.
  type, public :: contact_point_type
    integer :: law = 1                         !! which of the set's laws applies
    integer :: node = 0                        !! slave, number in its mesh
    integer :: line = 0                        !! number of the contact line it lies on
    integer :: strip = 1                       !! of strips side by side, which it lies on
    integer :: slave(spatial) = 0         !! the set's unknowns at the slave (u, v, w); 0: fixed
    integer, allocatable :: master(:, :)       !! (3, nodes) the same at the master's nodes
    real(wp), allocatable :: share(:)          !! (nodes) master's shape functions
    !> the set's unknowns that turn the faces about the nodes; not allocated: mid-surfaces touch
    integer, allocatable :: turn(:)
    real(wp), allocatable :: lever(:, :)  !! (3, turns) how a turn moves slave against master [m]
    real(wp) :: frame(spatial, spatial) = 0.0_wp !! columns: two tangents, normal towards the slave
    real(wp) :: length = 0.0_wp                !! of contact line the node stands for [m]
    real(wp) :: hardness = 1.0_wp              !! of this one, over the law's [1]
    !> between the unloaded foils at rest, or where a plate has been moved to [m]
    real(wp) :: gap = 0.0_wp
    logical :: pressed = .false.               !! the normal force is given, not a matter of contact
    real(wp) :: pressing = 0.0_wp              !! it [N]
    real(wp) :: shift(2) = 0.0_wp              !! u_s, of the tangents' zero [m]
    real(wp) :: place(spatial) = 0.0_wp        !! approach where the law is linearised [m]
    real(wp) :: anchor(spatial) = 0.0_wp       !! linearisation point that the step began at [m]
    real(wp) :: force(spatial) = 0.0_wp        !! (t_1, t_2, f_n) there [N]
    real(wp) :: derivative(spatial, spatial) = 0.0_wp !! of the force by the approach there [N/m]
    real(wp) :: old_slip(2) = 0.0_wp           !! tangential displacement at the last commit [m]
    real(wp) :: old_force(2) = 0.0_wp          !! friction then [N]
    !> in motion: the normal force that the stiffness of sticking is of [N]
    real(wp) :: stick_pressing = 0.0_wp
  end type contact_point_type

contains

  !> How far the slave has moved away from its master, global components [m].
  !>
  !> $$ u_s - \sum_a N_a u_a + \sum_k \mathbf{h}_k \theta_k $$
  !>
  !> with the levers h of the turns, where the foils touch at their faces.
  pure function moved_apart(point, displacement) result(relative)
    type(contact_point_type), intent(in) :: point !! the contact
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m], [rad]
    real(wp) :: relative(spatial)
    integer :: k

    relative = at_node(point%slave, displacement)
    do k = 1, size(point%share)
      relative = relative - point%share(k)*at_node(point%master(:, k), displacement)
    end do
    if (.not. allocated(point%turn)) return
    do k = 1, size(point%turn)
      if (point%turn(k) > 0) relative = relative + point%lever(:, k)*displacement(point%turn(k))
    end do
  end function moved_apart

  !> Displacement at a node, zero where it is fixed.
  pure function at_node(unknown, displacement) result(value)
    integer, intent(in) :: unknown(spatial)
    real(wp), intent(in) :: displacement(:)
    real(wp) :: value(spatial)
    integer :: k

    value = 0.0_wp
    do k = 1, spatial
      if (unknown(k) > 0) value(k) = displacement(unknown(k))
    end do
  end function at_node

  !> Adds what a force on the slave is for the unknowns of a contact: itself, the reverse on the
  !> master, and the moments of both about their nodes.
  pure subroutine add_at_contact(point, on_slave, force)
    type(contact_point_type), intent(in) :: point !! the contact
    real(wp), intent(in) :: on_slave(spatial) !! global components
    real(wp), intent(inout) :: force(:) !! added, by the set's unknowns
    integer :: k

    call add_at_node(point%slave, on_slave, force)
    do k = 1, size(point%share)
      call add_at_node(point%master(:, k), -point%share(k)*on_slave, force)
    end do
    if (.not. allocated(point%turn)) return
    do k = 1, size(point%turn)
      if (point%turn(k) == 0) cycle
      force(point%turn(k)) = force(point%turn(k)) + dot_product(point%lever(:, k), on_slave)
    end do
  end subroutine add_at_contact

  !> Adds a node's force where it is free.
  pure subroutine add_at_node(unknown, value, force)
    integer, intent(in) :: unknown(spatial)
    real(wp), intent(in) :: value(spatial)
    real(wp), intent(inout) :: force(:)
    integer :: k

    do k = 1, spatial
      if (unknown(k) > 0) force(unknown(k)) = force(unknown(k)) + value(k)
    end do
  end subroutine add_at_node

  !> The set's unknowns of a contact: slave, then master nodes, then turns; 0 where they are fixed.
  pure function unknowns_of(point) result(unknown)
    type(contact_point_type), intent(in) :: point !! the contact
    integer, allocatable :: unknown(:)

    unknown = [point%slave, reshape(point%master, [size(point%master)])]
    if (allocated(point%turn)) unknown = [unknown, point%turn]
  end function unknowns_of

  !> Stiffness of a contact in the order of `unknowns_of` from that of its slave against its master.
  pure function block_of(point, own) result(block)
    type(contact_point_type), intent(in) :: point !! the contact
    real(wp), intent(in) :: own(spatial, spatial) !! global components [N/m]
    real(wp), allocatable :: block(:, :)          !! [N/m], [N], [N m]
    real(wp) :: weight(size(point%share) + 1)
    real(wp), allocatable :: turning(:, :), turned(:, :)
    integer :: k, m, moved, turns

    weight = [1.0_wp, -point%share]
    moved = spatial*size(weight)
    turns = 0
    if (allocated(point%turn)) turns = size(point%turn)
    allocate (block(moved + turns, moved + turns))
    do m = 1, size(weight)
      do k = 1, size(weight)
        associate (row => spatial*(k - 1), column => spatial*(m - 1))
          block(row + 1:row + spatial, column + 1:column + spatial) = weight(k)*weight(m)*own
        end associate
      end do
    end do
    if (turns == 0) return
    turning = matmul(own, point%lever)
    block(moved + 1:, moved + 1:) = matmul(transpose(point%lever), turning)
    turned = matmul(transpose(point%lever), own)
    do k = 1, size(weight)
      associate (row => spatial*(k - 1))
        block(row + 1:row + spatial, moved + 1:) = weight(k)*turning
        block(moved + 1:, row + 1:row + spatial) = weight(k)*turned
      end associate
    end do
  end function block_of
end module gfb_contact_point

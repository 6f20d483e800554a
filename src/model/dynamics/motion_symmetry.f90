!> What motions of the shaft are felt by, and what they move, given their symmetry about z = 0.
!>
!> On half the width a bearing has motions of two symmetries: those of the steady state, and those
!> against the other half's mirror, whose pressures vanish at z = 0. Tilts are of the second kind.
module gfb_motion_symmetry
  use gfb_kinds, only: wp
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type, external)
  private
  public :: motion_weights, motion_unknowns

  !> of the shaft's coordinates
  integer, parameter, public :: translations(2) = [1, 2], tilts(2) = [3, 4]

contains

  !> \( B_j \, dA \) of the shaft's coordinates at the film nodes of all pads; torques are those
  !> on the shaft.
  pure function motion_weights(bearing, coordinate) result(weight)
    type(bearing_system_type), intent(in) :: bearing !! that vibrates
    integer, intent(in) :: coordinate(:) !! of the shaft; on half the width of one symmetry, or all
    real(wp) :: weight(size(coordinate), bearing%film_nodes()) !! this rank's [m2], [m3]
    integer :: i

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film)
        if (against_mirror(bearing, coordinate)) then
          weight(:, pad%first_node + 1:pad%last_node) = -film%half_torque_weight
        else
          weight(:, pad%first_node + 1:pad%last_node) = film%force_weight(coordinate, :)
        end if
      end associate
    end do
    if (size(coordinate) > size(tilts)) weight(tilts, :) = -weight(tilts, :)
  end function motion_weights

  !> 1 where such a motion has a local unknown of the bearing, else 0; the shaft's it never has.
  pure function motion_unknowns(bearing, coordinate, foils_move) result(has)
    type(bearing_system_type), intent(in) :: bearing !! that vibrates
    integer, intent(in) :: coordinate(:) !! of the shaft that move
    logical, intent(in) :: foils_move    !! or stay where they are
    real(wp) :: has(bearing%local_size())
    integer :: i

    has = 1.0_wp
    has(bearing%first_shaft + 1:) = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film, first => bearing%pad(i)%first)
        if (against_mirror(bearing, coordinate)) then
          where (abs(film%axial) <= epsilon(1.0_wp)*film%width)
            has(first + 1:first + size(film%axial)) = 0.0_wp
          end where
        end if
        if (.not. foils_move) has(first + pad%foil%first + 1:pad%last) = 0.0_wp
      end associate
    end do
  end function motion_unknowns

  !> Whether motions on half the width are those against the other half's mirror.
  pure function against_mirror(bearing, coordinate) result(against)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: coordinate(:) !! of the shaft that move
    logical :: against
    against = bearing%pad(1)%whole%half .and. coordinate(1) == tilts(1)
  end function against_mirror
end module gfb_motion_symmetry

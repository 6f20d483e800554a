!> Places at which the motion of a machine's shaft is shown: bearings, discs, stations.
module gfb_machine_places
  use gfb_text, only: text
  use gfb_machine_case, only: machine_case_type
  use gfb_shaft, only: node_at
  use gfb_machine, only: machine_type
  implicit none (type, external)
  private
  public :: shown_places, nodes_of_places

contains

  !> Their names: `bearing_1`, ...
  function shown_places(asked) result(place)
    type(machine_case_type), intent(in) :: asked !! what the case file asks for
    character(len=32), allocatable :: place(:)
    integer :: i

    place = [character(len=32) :: ('bearing_'//text(i), i=1, size(asked%bearing_position)), &
                                  ('disc_'//text(i), i=1, size(asked%disc_position)), &
                                  ('station_'//text(i), i=1, size(asked%station))]
  end function shown_places

  !> Their nodes on the shaft.
  pure function nodes_of_places(machine) result(node)
    type(machine_type), intent(in) :: machine
    integer, allocatable :: node(:)
    integer :: i

    node = [(node_at(machine%shaft, machine%journal(i)%position), i=1, size(machine%journal)), &
          machine%station]
  end function nodes_of_places
end module gfb_machine_places

"""What may stand in a file, as plain objects: materials, sections, bodies, joints, loads, prebuilt mechanisms.

Fields have the names that they have in a file, in SI units and global axes; what is a word of Python has a `_`
behind it (`from_`, `yield_`). A number may be a text with a unit or an expression. Nothing is checked here: the
loader checks it, when a mechanism is made of it.

Written by `generate.py` from the schema of files.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Literal, Optional, Union

from ._data import Count, Number, Numbers, Part
from ._mechanism import Prebuilt

__all__ = [
    "Beam",
    "Circle",
    "Copies",
    "CubicHexapod",
    "Cylindrical",
    "Delta",
    "Exechon",
    "Fixed",
    "Flexible",
    "Frame",
    "General",
    "Group",
    "Hexapod",
    "Joint",
    "Leg",
    "LinearDelta",
    "Link",
    "Load",
    "Mass",
    "Material",
    "Member",
    "Mirrored",
    "Misfit",
    "Modes",
    "Mount",
    "Moved",
    "Orthoglide",
    "Planar",
    "PlanarThreeRrr",
    "Preload",
    "Prismatic",
    "Rails",
    "Rectangle",
    "Revolute",
    "Rigid",
    "Screw",
    "SingleFreedom",
    "Spherical",
    "SphericalThreeRrr",
    "Stiffness",
    "Tapered",
    "ThreePrs",
    "ThreeRps",
    "Tricept",
    "Tripteron",
    "Tube",
    "Turned",
    "Universal",
]


class Circle(Part):
    """A solid round section.

    Parameters
    ----------
    diameter
        outer diameter [m]
    shear_y : optional
        effective shear area along local y [m²]
    shear_z : optional
        effective shear area along local z [m²]
    """
    _kind: ClassVar[Optional[str]] = "Circle"

    def __init__(
        self,
        *,
        diameter: Number,
        shear_y: Optional[Number] = None,
        shear_z: Optional[Number] = None,
    ) -> None:
        self._set(
            diameter=diameter,
            shear_y=shear_y,
            shear_z=shear_z,
        )


class General(Part):
    """Any section, by its properties.

    Parameters
    ----------
    area
        cross-section [m²]
    iy
        second moment about local y [m⁴]
    iz
        second moment about local z [m⁴]
    torsion
        torsion constant [m⁴]
    shear_y : optional
        effective shear area along local y [m²]
    shear_z : optional
        effective shear area along local z [m²]
    torsion_modulus : optional
        torque over shear stress, for stresses [m³]
    y_max : optional
        largest distance along local y, for stresses [m]
    z_max : optional
        largest distance along local z, for stresses [m]
    """
    _kind: ClassVar[Optional[str]] = "General"

    def __init__(
        self,
        *,
        area: Number,
        iy: Number,
        iz: Number,
        torsion: Number,
        shear_y: Optional[Number] = None,
        shear_z: Optional[Number] = None,
        torsion_modulus: Optional[Number] = None,
        y_max: Optional[Number] = None,
        z_max: Optional[Number] = None,
    ) -> None:
        self._set(
            area=area,
            iy=iy,
            iz=iz,
            torsion=torsion,
            shear_y=shear_y,
            shear_z=shear_z,
            torsion_modulus=torsion_modulus,
            y_max=y_max,
            z_max=z_max,
        )


class Rectangle(Part):
    """A solid rectangle.

    Parameters
    ----------
    height
        along local z [m]
    width
        along local y [m]
    shear_y : optional
        effective shear area along local y [m²]
    shear_z : optional
        effective shear area along local z [m²]
    """
    _kind: ClassVar[Optional[str]] = "Rectangle"

    def __init__(
        self,
        *,
        height: Number,
        width: Number,
        shear_y: Optional[Number] = None,
        shear_z: Optional[Number] = None,
    ) -> None:
        self._set(
            height=height,
            width=width,
            shear_y=shear_y,
            shear_z=shear_z,
        )


class Tube(Part):
    """A hollow round section.

    Parameters
    ----------
    inner
        inner diameter, below the outer one [m]
    outer
        outer diameter [m]
    shear_y : optional
        effective shear area along local y [m²]
    shear_z : optional
        effective shear area along local z [m²]
    """
    _kind: ClassVar[Optional[str]] = "Tube"

    def __init__(
        self,
        *,
        inner: Number,
        outer: Number,
        shear_y: Optional[Number] = None,
        shear_z: Optional[Number] = None,
    ) -> None:
        self._set(
            inner=inner,
            outer=outer,
            shear_y=shear_y,
            shear_z=shear_z,
        )


class Tapered(Part):
    """A section that changes along what it is used for.

    Parameters
    ----------
    from_
        the section at the first point
    to
        the section at the last point, of the same kind
    """
    _kind: ClassVar[Optional[str]] = "Tapered"
    _words: ClassVar[Mapping[str, str]] = {"from_": "from"}

    def __init__(
        self,
        *,
        from_: Union[Circle, General, Rectangle, Tube],
        to: Union[Circle, General, Rectangle, Tube],
    ) -> None:
        self._set(
            from_=from_,
            to=to,
        )


class Cylindrical(Part):
    """Turns about its axis and slides along it.

    Parameters
    ----------
    axis
        the joint's axis, y of its frame
    """
    _kind: ClassVar[Optional[str]] = "Cylindrical"

    def __init__(
        self,
        *,
        axis: Numbers,
    ) -> None:
        self._set(
            axis=axis,
        )


class Fixed(Part):
    """A weld, or with `stiffness` a bushing.

    Parameters
    ----------
    axis : optional
        y of the joint frame
    """
    _kind: ClassVar[Optional[str]] = "Fixed"

    def __init__(
        self,
        *,
        axis: Optional[Numbers] = None,
    ) -> None:
        self._set(
            axis=axis,
        )


class Planar(Part):
    """Slides in a plane and turns about its normal.

    Parameters
    ----------
    normal
        the plane's normal, y of the joint frame
    """
    _kind: ClassVar[Optional[str]] = "Planar"

    def __init__(
        self,
        *,
        normal: Numbers,
    ) -> None:
        self._set(
            normal=normal,
        )


class Prismatic(Part):
    """Slides along its axis.

    Parameters
    ----------
    axis
        the joint's axis, y of its frame
    """
    _kind: ClassVar[Optional[str]] = "Prismatic"

    def __init__(
        self,
        *,
        axis: Numbers,
    ) -> None:
        self._set(
            axis=axis,
        )


class Revolute(Part):
    """Turns about its axis.

    Parameters
    ----------
    axis
        the joint's axis, y of its frame
    """
    _kind: ClassVar[Optional[str]] = "Revolute"

    def __init__(
        self,
        *,
        axis: Numbers,
    ) -> None:
        self._set(
            axis=axis,
        )


class Screw(Part):
    """Turns about its axis and advances along it.

    Parameters
    ----------
    axis
        the joint's axis, y of its frame
    pitch
        advance a radian, right-handed [m/rad]
    """
    _kind: ClassVar[Optional[str]] = "Screw"

    def __init__(
        self,
        *,
        axis: Numbers,
        pitch: Number,
    ) -> None:
        self._set(
            axis=axis,
            pitch=pitch,
        )


class Spherical(Part):
    """Turns about its point.

    Parameters
    ----------
    axis : optional
        y of the joint frame
    """
    _kind: ClassVar[Optional[str]] = "Spherical"

    def __init__(
        self,
        *,
        axis: Optional[Numbers] = None,
    ) -> None:
        self._set(
            axis=axis,
        )


class Universal(Part):
    """Turns about two axes.

    Parameters
    ----------
    axes
        the axis fixed in the first body, and that in the second
    """
    _kind: ClassVar[Optional[str]] = "Universal"

    def __init__(
        self,
        *,
        axes: tuple[Numbers, Numbers],
    ) -> None:
        self._set(
            axes=axes,
        )


class Beam(Part):
    """A straight or bent chain of elastic beams.

    Parameters
    ----------
    material
        a material's name
    section
        a section's name, or a list of one for each segment
    through
        names of two or more points
    elements : optional
        elements of every segment
    temperature : optional
        change of its temperature [K]
    y_axis : optional
        direction of local y, made normal to each segment, or a list of one for each
    """
    _kind: ClassVar[Optional[str]] = "Beam"

    def __init__(
        self,
        *,
        material: Union[str, Material],
        section: Union[str, Circle, General, Rectangle, Tapered, Tube, Sequence[Union[str, Circle, General, Rectangle, Tapered, Tube]]],
        through: Sequence[str],
        elements: Optional[Count] = None,
        temperature: Optional[Number] = None,
        y_axis: Optional[Union[Numbers, Sequence[Numbers]]] = None,
    ) -> None:
        self._set(
            material=material,
            section=section,
            through=through,
            elements=elements,
            temperature=temperature,
            y_axis=y_axis,
        )


class Flexible(Part):
    """An elastic body by its stiffness over its points.

    Parameters
    ----------
    points
        names of its points
    stiffness
        six rows and columns a point, of the free body
    temperature : optional
        change of its temperature [K]
    """
    _kind: ClassVar[Optional[str]] = "Flexible"

    def __init__(
        self,
        *,
        points: Sequence[str],
        stiffness: Any,
        temperature: Optional[Number] = None,
    ) -> None:
        self._set(
            points=points,
            stiffness=stiffness,
            temperature=temperature,
        )


class Frame(Part):
    """Beams that are welded at the points they share.

    Parameters
    ----------
    members
        lists of points, or beams with fields of their own
    elements : optional
        elements of every segment
    material : optional
        of members that do not give their own
    section : optional
        of members that do not give their own
    temperature : optional
        change of its temperature [K]
    y_axis : optional
        direction of local y, made normal to each segment, or a list of one for each
    """
    _kind: ClassVar[Optional[str]] = "Frame"

    def __init__(
        self,
        *,
        members: Sequence[Union[Sequence[str], Member]],
        elements: Optional[Count] = None,
        material: Optional[Union[str, Material]] = None,
        section: Optional[Union[str, Circle, General, Rectangle, Tapered, Tube, Sequence[Union[str, Circle, General, Rectangle, Tapered, Tube]]]] = None,
        temperature: Optional[Number] = None,
        y_axis: Optional[Union[Numbers, Sequence[Numbers]]] = None,
    ) -> None:
        self._set(
            members=members,
            elements=elements,
            material=material,
            section=section,
            temperature=temperature,
            y_axis=y_axis,
        )


class Rigid(Part):
    """One rigid body.

    Parameters
    ----------
    points
        names of its points
    temperature : optional
        change of its temperature [K]
    """
    _kind: ClassVar[Optional[str]] = "Rigid"

    def __init__(
        self,
        *,
        points: Sequence[str],
        temperature: Optional[Number] = None,
    ) -> None:
        self._set(
            points=points,
            temperature=temperature,
        )


class Mirrored(Part):
    """As it is written, and its mirror image.

    Parameters
    ----------
    normal
        of the plane
    through : optional
        a point of the axis or plane, else the origin [m]
    """
    _kind: ClassVar[Optional[str]] = "Mirrored"

    def __init__(
        self,
        *,
        normal: Numbers,
        through: Optional[Numbers] = None,
    ) -> None:
        self._set(
            normal=normal,
            through=through,
        )


class Moved(Part):
    """Moved step by step, or each by its own vector.

    Parameters
    ----------
    by
        the step, or each vector
    count : optional
        number of copies
    """
    _kind: ClassVar[Optional[str]] = "Moved"

    def __init__(
        self,
        *,
        by: Union[Numbers, Sequence[Numbers]],
        count: Optional[Count] = None,
    ) -> None:
        self._set(
            by=by,
            count=count,
        )


class Turned(Part):
    """Turned about an axis, all round or step by step.

    Parameters
    ----------
    axis
        the axis
    angles : optional
        of each [rad]
    count : optional
        number of copies
    step : optional
        from one to the next [rad]
    through : optional
        a point of the axis or plane, else the origin [m]
    """
    _kind: ClassVar[Optional[str]] = "Turned"

    def __init__(
        self,
        *,
        axis: Numbers,
        angles: Optional[Numbers] = None,
        count: Optional[Count] = None,
        step: Optional[Number] = None,
        through: Optional[Numbers] = None,
    ) -> None:
        self._set(
            axis=axis,
            angles=angles,
            count=count,
            step=step,
            through=through,
        )


class Material(Part):
    """A material; exactly one of `poisson` and `shear`.

    Parameters
    ----------
    young
        Young's modulus E [Pa]
    density : optional
        needed for gravity and natural frequencies [kg/m³]
    expansion : optional
        coefficient of linear thermal expansion [1/K]
    poisson : optional
        Poisson's ratio, above -1, at most 0.5
    shear : optional
        the shear modulus G itself [Pa]
    yield_ : optional
        yield strength, for utilisations [Pa]
    """
    _words: ClassVar[Mapping[str, str]] = {"yield_": "yield"}

    def __init__(
        self,
        *,
        young: Number,
        density: Optional[Number] = None,
        expansion: Optional[Number] = None,
        poisson: Optional[Number] = None,
        shear: Optional[Number] = None,
        yield_: Optional[Number] = None,
    ) -> None:
        self._set(
            young=young,
            density=density,
            expansion=expansion,
            poisson=poisson,
            shear=shear,
            yield_=yield_,
        )


class Link(Part):
    """What a link is made of.

    Parameters
    ----------
    material
        its material
    section
        its section
    """

    def __init__(
        self,
        *,
        material: Material,
        section: Union[Circle, General, Rectangle, Tube],
    ) -> None:
        self._set(
            material=material,
            section=section,
        )


class Leg(Part):
    """A telescopic leg, with its drive between cylinder and piston.

    Parameters
    ----------
    cylinder
        what it is made of
    cylinder_length
        from the base joint to the drive [m]
    lengths
        of the whole leg: shortest and longest [m]
    piston
        what it is made of
    """

    def __init__(
        self,
        *,
        cylinder: Link,
        cylinder_length: Number,
        lengths: Numbers,
        piston: Link,
    ) -> None:
        self._set(
            cylinder=cylinder,
            cylinder_length=cylinder_length,
            lengths=lengths,
            piston=piston,
        )


class Rails(Part):
    """Rails on which carriages slide.

    Parameters
    ----------
    radius
        from z to the rails' feet, at z = 0 [m]
    travel
        of a carriage from its rail's foot [m]
    carriage : optional
        which of the two places on its rail a carriage takes
    tilt : optional
        by how much they lean inward [rad]
    """

    def __init__(
        self,
        *,
        radius: Number,
        travel: Number,
        carriage: Optional[Literal["Near", "Far"]] = None,
        tilt: Optional[Number] = None,
    ) -> None:
        self._set(
            radius=radius,
            travel=travel,
            carriage=carriage,
            tilt=tilt,
        )


class Load(Part):
    """A load on a point of a body, or along a beam.

    Parameters
    ----------
    on
        body and point; of a load along beams the body, or body and two neighbouring points
    force : optional
        force on the point [N]
    frame : optional
        the body with which it turns
    from_ : optional
        force per length at the first point [N/m]
    moment : optional
        moment on the point [N·m]
    moment_per_length : optional
        moment per length of the beam [N·m/m]
    per_length : optional
        force per length of the beam [N/m]
    to : optional
        force per length at the second point [N/m]
    """
    _words: ClassVar[Mapping[str, str]] = {"from_": "from"}

    def __init__(
        self,
        *,
        on: Union[str, tuple[str, str], tuple[str, str, str]],
        force: Optional[Numbers] = None,
        frame: Optional[Literal["Global", "Body", "Output"]] = None,
        from_: Optional[Numbers] = None,
        moment: Optional[Numbers] = None,
        moment_per_length: Optional[Numbers] = None,
        per_length: Optional[Numbers] = None,
        to: Optional[Numbers] = None,
    ) -> None:
        self._set(
            on=on,
            force=force,
            frame=frame,
            from_=from_,
            moment=moment,
            moment_per_length=moment_per_length,
            per_length=per_length,
            to=to,
        )


class Mass(Part):
    """A rigid mass on a point of a body, its centre.

    Parameters
    ----------
    mass
        how much [kg]
    on
        body and point
    inertia : optional
        moments of inertia, or Jxx Jyy Jzz Jxy Jxz Jyz
    """

    def __init__(
        self,
        *,
        mass: Number,
        on: tuple[str, str],
        inertia: Optional[Numbers] = None,
    ) -> None:
        self._set(
            mass=mass,
            on=on,
            inertia=inertia,
        )


class Joint(Part):
    """A joint between two bodies.

    Parameters
    ----------
    at
        name of a point that both bodies have
    between
        two bodies; either may be `ground`
    kind
        which motions it leaves free
    locked : optional
        whether all free directions are held, or which
    misfit : optional
        what the second body stands off from the first
    preload : optional
        what presses the bodies on each other
    stiffness : optional
        elastic directions
    x_axis : optional
        direction of the joint frame's x
    """

    def __init__(
        self,
        *,
        at: str,
        between: tuple[str, str],
        kind: Union[Cylindrical, Fixed, Planar, Prismatic, Revolute, Screw, Spherical, Universal, Literal["Fixed", "Spherical"]],
        locked: Optional[Union[bool, Sequence[Literal["x", "y", "z", "u", "v", "w"]]]] = None,
        misfit: Optional[Misfit] = None,
        preload: Optional[Preload] = None,
        stiffness: Any = None,
        x_axis: Optional[Numbers] = None,
    ) -> None:
        self._set(
            at=at,
            between=between,
            kind=kind,
            locked=locked,
            misfit=misfit,
            preload=preload,
            stiffness=stiffness,
            x_axis=x_axis,
        )


class Misfit(Part):
    """What the second body stands off from the first, in the joint frame.

    Parameters
    ----------
    u : optional
        about x [rad]
    v : optional
        about y [rad]
    w : optional
        about z [rad]
    x : optional
        along x [m]
    y : optional
        along y [m]
    z : optional
        along z [m]
    """

    def __init__(
        self,
        *,
        u: Optional[Number] = None,
        v: Optional[Number] = None,
        w: Optional[Number] = None,
        x: Optional[Number] = None,
        y: Optional[Number] = None,
        z: Optional[Number] = None,
    ) -> None:
        self._set(
            u=u,
            v=v,
            w=w,
            x=x,
            y=y,
            z=z,
        )


class Preload(Part):
    """What acts on the second body, and its opposite on the first, in the joint frame.

    Parameters
    ----------
    u : optional
        about x [N·m]
    v : optional
        about y [N·m]
    w : optional
        about z [N·m]
    x : optional
        along x [N]
    y : optional
        along y [N]
    z : optional
        along z [N]
    """

    def __init__(
        self,
        *,
        u: Optional[Number] = None,
        v: Optional[Number] = None,
        w: Optional[Number] = None,
        x: Optional[Number] = None,
        y: Optional[Number] = None,
        z: Optional[Number] = None,
    ) -> None:
        self._set(
            u=u,
            v=v,
            w=w,
            x=x,
            y=y,
            z=z,
        )


class Stiffness(Part):
    """Stiffnesses by direction of the joint frame; 0 frees a direction.

    Parameters
    ----------
    u : optional
        about x [N·m/rad]
    v : optional
        about y [N·m/rad]
    w : optional
        about z [N·m/rad]
    x : optional
        along x [N/m]
    y : optional
        along y [N/m]
    z : optional
        along z [N/m]
    """

    def __init__(
        self,
        *,
        u: Optional[Number] = None,
        v: Optional[Number] = None,
        w: Optional[Number] = None,
        x: Optional[Number] = None,
        y: Optional[Number] = None,
        z: Optional[Number] = None,
    ) -> None:
        self._set(
            u=u,
            v=v,
            w=w,
            x=x,
            y=y,
            z=z,
        )


class Member(Part):
    """A beam of a frame; what it does not give, it takes from the frame.

    Parameters
    ----------
    through
        names of points
    elements : optional
        elements of every segment
    material : optional
        a material's name
    offset : optional
        from a point to the member's end, by the point: a rigid arm, global axes [m]
    releases : optional
        directions that an end does not carry, by its point, along the member's own axes
    section : optional
        a section's name, or a list of one for each segment
    springs : optional
        springs between an end and the frame, by its point, along the member's own axes
    y_axis : optional
        direction of local y, made normal to each segment, or a list of one for each
    """

    def __init__(
        self,
        *,
        through: Sequence[str],
        elements: Optional[Count] = None,
        material: Optional[Union[str, Material]] = None,
        offset: Optional[Mapping[str, Numbers]] = None,
        releases: Optional[Mapping[str, Sequence[Literal["x", "y", "z", "u", "v", "w"]]]] = None,
        section: Optional[Union[str, Circle, General, Rectangle, Tapered, Tube, Sequence[Union[str, Circle, General, Rectangle, Tapered, Tube]]]] = None,
        springs: Optional[Mapping[str, Stiffness]] = None,
        y_axis: Optional[Union[Numbers, Sequence[Numbers]]] = None,
    ) -> None:
        self._set(
            through=through,
            elements=elements,
            material=material,
            offset=offset,
            releases=releases,
            section=section,
            springs=springs,
            y_axis=y_axis,
        )


class Modes(Part):
    """Natural frequencies.

    Parameters
    ----------
    count
        number of frequencies
    mass : optional
        masses of beams
    rotary_inertia : optional
        whether sections have inertia in bending
    shape : optional
        of consistent masses
    """

    def __init__(
        self,
        *,
        count: Count,
        mass: Optional[Literal["Exact", "Consistent", "Lumped"]] = None,
        rotary_inertia: Optional[bool] = None,
        shape: Optional[Literal["Cubic", "Exact"]] = None,
    ) -> None:
        self._set(
            count=count,
            mass=mass,
            rotary_inertia=rotary_inertia,
            shape=shape,
        )


class Group(Part):
    """A part of a mechanism that is written once.

    Parameters
    ----------
    bodies : optional
        bodies by name
    joints : optional
        joints by name
    loads : optional
        loads on each copy
    masses : optional
        masses on each copy
    points : optional
        places by name [m]
    """

    def __init__(
        self,
        *,
        bodies: Optional[Mapping[str, Union[Beam, Flexible, Frame, Rigid]]] = None,
        joints: Optional[Mapping[str, Joint]] = None,
        loads: Optional[Sequence[Load]] = None,
        masses: Optional[Sequence[Mass]] = None,
        points: Optional[Mapping[str, Numbers]] = None,
    ) -> None:
        self._set(
            bodies=bodies,
            joints=joints,
            loads=loads,
            masses=masses,
            points=points,
        )


class Copies(Part):
    """Copies of a group.

    Parameters
    ----------
    places
        where they stand
    names : optional
        what is put behind the names of each
    overrides : optional
        other values of single copies, by path in the group
    """

    def __init__(
        self,
        *,
        places: Union[Union[Mirrored, Moved, Turned], Sequence[Union[Mirrored, Moved, Turned]]],
        names: Optional[Sequence[str]] = None,
        overrides: Optional[Mapping[str, Mapping[str, Any]]] = None,
    ) -> None:
        self._set(
            places=places,
            names=names,
            overrides=overrides,
        )


class Mount(Part):
    """A mechanism of another file, a part of this one.

    Parameters
    ----------
    file
        the file, relative to this one
    on
        body and point to which its ground is welded
    at : optional
        where its origin stands, and how it is turned (a rotation vector)
    output : optional
        body and point of it that are the output of all
    """

    def __init__(
        self,
        *,
        file: str,
        on: tuple[str, str],
        at: Optional[Numbers] = None,
        output: Optional[tuple[str, str]] = None,
    ) -> None:
        self._set(
            file=file,
            on=on,
            at=at,
            output=output,
        )


class CubicHexapod(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    edge
        of the cube: length of the legs at home [m]
    leg
        the telescopic legs
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "CubicHexapod"

    def __init__(
        self,
        *,
        edge: Number,
        leg: Leg,
        drive_stiffness: Optional[Number] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            edge=edge,
            leg=leg,
            drive_stiffness=drive_stiffness,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class Delta(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    arm
        the arms
    arm_length
        A_i B_i [m]
    bar
        both cross links of a limb
    base_radius
        from the base's centre to each A_i [m]
    platform_radius
        from the platform's centre to each C_i [m]
    rod
        the rods
    rod_length
        of the parallelogram's rods [m]
    rod_spacing
        distance of the two rods of a limb [m]
    drive_stiffness : optional
        of the drives; left out: rigid [N·m/rad]
    elbow : optional
        the elbow farther along the limb's outward direction, or the other
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    rod_ends : optional
        the joints of the rods
    """
    _kind: ClassVar[Optional[str]] = "Delta"

    def __init__(
        self,
        *,
        arm: Link,
        arm_length: Number,
        bar: Link,
        base_radius: Number,
        platform_radius: Number,
        rod: Link,
        rod_length: Number,
        rod_spacing: Number,
        drive_stiffness: Optional[Number] = None,
        elbow: Optional[Literal["Out", "In"]] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
        rod_ends: Optional[Literal["Revolute", "Spherical"]] = None,
    ) -> None:
        self._set(
            arm=arm,
            arm_length=arm_length,
            bar=bar,
            base_radius=base_radius,
            platform_radius=platform_radius,
            rod=rod,
            rod_length=rod_length,
            rod_spacing=rod_spacing,
            drive_stiffness=drive_stiffness,
            elbow=elbow,
            elements=elements,
            joint_stiffness=joint_stiffness,
            rod_ends=rod_ends,
        )


class Exechon(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    base_depth
        of A_3 from the line A_1 A_2 [m]
    base_width
        A_1 A_2 [m]
    housing
        a leg's half at the base
    platform_depth
        of B_3 from the line B_1 B_2 [m]
    platform_width
        B_1 B_2 [m]
    ram
        a leg's half at the platform
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "Exechon"

    def __init__(
        self,
        *,
        base_depth: Number,
        base_width: Number,
        housing: Link,
        platform_depth: Number,
        platform_width: Number,
        ram: Link,
        drive_stiffness: Optional[Number] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            base_depth=base_depth,
            base_width=base_width,
            housing=housing,
            platform_depth=platform_depth,
            platform_width=platform_width,
            ram=ram,
            drive_stiffness=drive_stiffness,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class Hexapod(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    base_angle
        half the angle between the joints of a pair, 0 to π/3 [rad]
    base_radius
        from the origin to each B_i [m]
    leg
        the telescopic legs
    platform_angle
        half the angle between the joints of a pair, 0 to π/3 [rad]
    platform_radius
        from P to each S_i [m]
    base_joints : optional
        with which the legs stand
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "Hexapod"

    def __init__(
        self,
        *,
        base_angle: Number,
        base_radius: Number,
        leg: Leg,
        platform_angle: Number,
        platform_radius: Number,
        base_joints: Optional[Literal["Universal", "Spherical"]] = None,
        drive_stiffness: Optional[Number] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            base_angle=base_angle,
            base_radius=base_radius,
            leg=leg,
            platform_angle=platform_angle,
            platform_radius=platform_radius,
            base_joints=base_joints,
            drive_stiffness=drive_stiffness,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class LinearDelta(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    platform_radius
        from P to each C_i [m]
    rails
        on which the carriages slide
    rod
        what the rods are made of
    rod_length
        of the rods [m]
    rod_spacing
        distance of the two rods of a limb [m]
    carriage_joints : optional
        of the rods, at the carriages
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "LinearDelta"

    def __init__(
        self,
        *,
        platform_radius: Number,
        rails: Rails,
        rod: Link,
        rod_length: Number,
        rod_spacing: Number,
        carriage_joints: Optional[Literal["Universal", "Spherical"]] = None,
        drive_stiffness: Optional[Number] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            platform_radius=platform_radius,
            rails=rails,
            rod=rod,
            rod_length=rod_length,
            rod_spacing=rod_spacing,
            carriage_joints=carriage_joints,
            drive_stiffness=drive_stiffness,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class Orthoglide(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    bar
        both cross links
    platform_radius
        from P to each C_i, against the limb's axis [m]
    rod
        what the rods are made of
    rod_length
        of the parallelogram's rods [m]
    rod_spacing
        distance of the two rods of a limb [m]
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "Orthoglide"

    def __init__(
        self,
        *,
        bar: Link,
        platform_radius: Number,
        rod: Link,
        rod_length: Number,
        rod_spacing: Number,
        drive_stiffness: Optional[Number] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            bar=bar,
            platform_radius=platform_radius,
            rod=rod,
            rod_length=rod_length,
            rod_spacing=rod_spacing,
            drive_stiffness=drive_stiffness,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class PlanarThreeRrr(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    base_radius
        from z to each A_i [m]
    distal
        the links at the platform
    distal_length
        B_i C_i [m]
    platform_radius
        from P to each C_i [m]
    proximal
        the links at the base
    proximal_length
        A_i B_i [m]
    drive_stiffness : optional
        of the drives; left out: rigid [N·m/rad]
    elbow : optional
        to which side the elbows are, seen along the limb
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "PlanarThreeRrr"

    def __init__(
        self,
        *,
        base_radius: Number,
        distal: Link,
        distal_length: Number,
        platform_radius: Number,
        proximal: Link,
        proximal_length: Number,
        drive_stiffness: Optional[Number] = None,
        elbow: Optional[Literal["Left", "Right"]] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            base_radius=base_radius,
            distal=distal,
            distal_length=distal_length,
            platform_radius=platform_radius,
            proximal=proximal,
            proximal_length=proximal_length,
            drive_stiffness=drive_stiffness,
            elbow=elbow,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class SingleFreedom(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    joint_stiffness
        along x at B and at C; 0 is free
    lengths
        of AB and CD [m]
    material
        of both
    sections
        of AB and CD
    """
    _kind: ClassVar[Optional[str]] = "SingleFreedom"

    def __init__(
        self,
        *,
        joint_stiffness: tuple[Union[Number, Literal["Rigid"]], Union[Number, Literal["Rigid"]]],
        lengths: Numbers,
        material: Material,
        sections: tuple[Union[Circle, General, Rectangle, Tube], Union[Circle, General, Rectangle, Tube]],
    ) -> None:
        self._set(
            joint_stiffness=joint_stiffness,
            lengths=lengths,
            material=material,
            sections=sections,
        )


class SphericalThreeRrr(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    base_angle
        of the axes of A_i from -z [rad]
    distal
        the links at the platform
    distal_angle
        between the axes of B_i and C_i [rad]
    platform_angle
        of the axes of C_i from z, at home [rad]
    proximal
        the links at the base
    proximal_angle
        between the axes of A_i and B_i [rad]
    radius
        of all joints from O [m]
    drive_stiffness : optional
        of the drives; left out: rigid [N·m/rad]
    elbow : optional
        to which side the elbows are, seen from outside
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "SphericalThreeRrr"

    def __init__(
        self,
        *,
        base_angle: Number,
        distal: Link,
        distal_angle: Number,
        platform_angle: Number,
        proximal: Link,
        proximal_angle: Number,
        radius: Number,
        drive_stiffness: Optional[Number] = None,
        elbow: Optional[Literal["Left", "Right"]] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            base_angle=base_angle,
            distal=distal,
            distal_angle=distal_angle,
            platform_angle=platform_angle,
            proximal=proximal,
            proximal_angle=proximal_angle,
            radius=radius,
            drive_stiffness=drive_stiffness,
            elbow=elbow,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class ThreePrs(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    platform_radius
        from P to each S_i [m]
    rails
        on which the carriages slide
    rod
        what the rods are made of
    rod_length
        A_i S_i [m]
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "ThreePrs"

    def __init__(
        self,
        *,
        platform_radius: Number,
        rails: Rails,
        rod: Link,
        rod_length: Number,
        drive_stiffness: Optional[Number] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            platform_radius=platform_radius,
            rails=rails,
            rod=rod,
            rod_length=rod_length,
            drive_stiffness=drive_stiffness,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class ThreeRps(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    base_radius
        from z to each B_i [m]
    leg
        the telescopic legs
    platform_radius
        from P to each S_i [m]
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "ThreeRps"

    def __init__(
        self,
        *,
        base_radius: Number,
        leg: Leg,
        platform_radius: Number,
        drive_stiffness: Optional[Number] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            base_radius=base_radius,
            leg=leg,
            platform_radius=platform_radius,
            drive_stiffness=drive_stiffness,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class Tricept(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    base_radius
        from O to each B_i [m]
    leg
        the telescopic legs
    platform_radius
        from P to each S_i [m]
    spline
        the middle leg's half at the platform
    tube
        the middle leg's half at the base
    tube_length
        O M; P is farther from O [m]
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "Tricept"

    def __init__(
        self,
        *,
        base_radius: Number,
        leg: Leg,
        platform_radius: Number,
        spline: Link,
        tube: Link,
        tube_length: Number,
        drive_stiffness: Optional[Number] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            base_radius=base_radius,
            leg=leg,
            platform_radius=platform_radius,
            spline=spline,
            tube=tube,
            tube_length=tube_length,
            drive_stiffness=drive_stiffness,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )


class Tripteron(Prebuilt):
    """A prebuilt mechanism.

    Parameters
    ----------
    distal
        the links at the platform
    distal_length
        B_i C_i [m]
    platform_radius
        from P to each C_i, against the limb's axis [m]
    proximal
        the links at the rail
    proximal_length
        A_i B_i [m]
    rail
        place of a limb's rail in the plane normal to it [m]
    drive_stiffness : optional
        of the drives; left out: rigid [N/m]
    elbow : optional
        to which side the elbows are, seen along the limb
    elements : optional
        of every segment; changes no result
    joint_stiffness : optional
        of every passive joint, in its frame; left out: rigid
    """
    _kind: ClassVar[Optional[str]] = "Tripteron"

    def __init__(
        self,
        *,
        distal: Link,
        distal_length: Number,
        platform_radius: Number,
        proximal: Link,
        proximal_length: Number,
        rail: Numbers,
        drive_stiffness: Optional[Number] = None,
        elbow: Optional[Literal["Left", "Right"]] = None,
        elements: Optional[Count] = None,
        joint_stiffness: Optional[Stiffness] = None,
    ) -> None:
        self._set(
            distal=distal,
            distal_length=distal_length,
            platform_radius=platform_radius,
            proximal=proximal,
            proximal_length=proximal_length,
            rail=rail,
            drive_stiffness=drive_stiffness,
            elbow=elbow,
            elements=elements,
            joint_stiffness=joint_stiffness,
        )
